/// @file
/// What `occt_model.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/models/occt/bounds.hpp"
#include "dovetail/models/occt/brep.hpp"
#include "dovetail/models/occt/healed_brep.hpp"
#include "dovetail/models/occt/read.hpp"
#include "dovetail/models/occt/repair.hpp"
#include "dovetail/models/occt/touching_faces.hpp"
#include "dovetail/models/occt_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace occt {

/// How many entities a shape has.
struct shape_counts {
  std::size_t solids = 0;
  std::size_t faces = 0;
  std::size_t curves = 0;
  std::size_t vertices = 0;

  using fields =
      field_list<&shape_counts::solids, &shape_counts::faces, &shape_counts::curves, &shape_counts::vertices>;
};

/// Calls `evaluate`; a failure inside OCCT becomes a `geometry_error` that names the entity.
template <class Query>
auto query(const char* kind, local_id id, Query&& evaluate) -> decltype(evaluate()) {
  try {
    return evaluate();
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure& failure) {
    throw geometry_error(std::string(kind) + " " + std::to_string(id) +
                         " cannot be evaluated: " + failure.GetMessageString());
  }
}

inline double nearest_parameter(const GeomAdaptor_Curve& curve, const std::array<double, 2>& range, vec3 p,
                                double t) {
  const double width = range[1] - range[0];
  t = std::clamp(t, range[0], range[1]);
  for (int step = 0; step < 40; ++step) {
    gp_Pnt q;
    gp_Vec first, second;
    curve.D2(t, q, first, second);
    const vec3 r = to_vec3(q) - p, d1 = to_vec3(first.XYZ()), d2 = to_vec3(second.XYZ());
    const double slope = dot(r, d1), gauss = dot(d1, d1), hessian = gauss + dot(r, d2);
    if (!(gauss > 0))
      return t;
    const double direction = -slope / (hessian > 1e-3 * gauss ? hessian : gauss);
    double next = std::clamp(t + direction, range[0], range[1]);
    const double value = dot(r, r);
    for (int halving = 0; halving < 20; ++halving) {
      if (norm_squared(to_vec3(curve.Value(next)) - p) <= value)
        break;
      next = t + 0.25 * (next - t);
    }
    const bool done = std::abs(next - t) <= 1e-14 * width;
    t = next;
    if (done)
      break;
  }
  return t;
}

/// What evaluates a model's geometry, with the caches that evaluation fills.
struct evaluators {
  explicit evaluators(const brep& data)
      : curves(data.curves), surfaces(data.surfaces), coedges(data.coedges) {}
  /// With caches of its own.
  evaluators(const evaluators& other)
      : curves(other.curves), surfaces(other.surfaces), coedges(other.coedges) {
    for (auto& curve : curves)
      if (!curve.Curve().IsNull())
        curve = GeomAdaptor_Curve(curve.Curve());
    for (auto& surface : surfaces)
      surface = surface.independent_copy();
    for (auto& face : coedges)
      for (auto& coedge : face)
        coedge = coedge.independent_copy();
  }
  evaluators& operator=(const evaluators&) = delete;

  const GeomAdaptor_Curve& curve(local_id c) const { return curves[c]; }
  const face_surface& surface(local_id f) const { return surfaces[f]; }

  std::vector<GeomAdaptor_Curve> curves;
  std::vector<face_surface> surfaces;
  std::vector<std::vector<coedge_curve>> coedges;
};

} // namespace occt

DOVETAIL_INLINE_OCCT occt_model::occt_model(occt::brep data)
    : data_(std::make_shared<const occt::brep>(std::move(data))), topology_(&data_->topology),
      own_(std::make_unique<occt::evaluators>(*data_)), bounds_(occt::bounds_of(*data_)) {}
DOVETAIL_INLINE_OCCT occt_model::occt_model(const occt_model& other)
    : data_(other.data_), topology_(other.topology_), own_(std::make_unique<occt::evaluators>(*other.own_)),
      bounds_(other.bounds_) {}
DOVETAIL_INLINE_OCCT occt_model& occt_model::operator=(const occt_model& other) {
  return *this = occt_model(other);
}
DOVETAIL_INLINE_OCCT occt_model::occt_model(occt_model&&) noexcept = default;
DOVETAIL_INLINE_OCCT occt_model& occt_model::operator=(occt_model&&) noexcept = default;
DOVETAIL_INLINE_OCCT occt_model::~occt_model() = default;

DOVETAIL_INLINE_OCCT const TopoDS_Shape& occt_model::shape() const {
  return data_->shape;
}

DOVETAIL_INLINE_OCCT vec3 occt_model::pole(local_id c) const {
  const auto& curve = topology_->curves[c];
  return topology_->vertices[curve.vertices[0]].point;
}

DOVETAIL_INLINE_OCCT vec3 occt_model::curve_point(local_id c, double t) const {
  if (topology_->curves[c].degenerate)
    return pole(c);
  return occt::query("curve", c, [&] { return occt::to_vec3(own_->curve(c).Value(t)); });
}

DOVETAIL_INLINE_OCCT dovetail::curve_frame occt_model::curve_frame(local_id c, double t) const {
  if (topology_->curves[c].degenerate)
    return {pole(c), {}};
  return occt::query("curve", c, [&] {
    gp_Pnt p;
    gp_Vec d;
    own_->curve(c).D1(t, p, d);
    return dovetail::curve_frame{occt::to_vec3(p), occt::to_vec3(d.XYZ())};
  });
}

DOVETAIL_INLINE_OCCT vec2 occt_model::curve_uv(local_id f, int k, double t) const {
  return occt::query("face", f, [&] {
    const auto& coedges = own_->coedges[f];
    return coedges[k].at(t, own_->surface(f));
  });
}

DOVETAIL_INLINE_OCCT vec3 occt_model::face_point(local_id f, vec2 uv) const {
  return occt::query("face", f, [&] { return own_->surface(f).point(uv); });
}

DOVETAIL_INLINE_OCCT surface_frame occt_model::face_frame(local_id f, vec2 uv) const {
  return occt::query("face", f, [&] { return own_->surface(f).frame(uv); });
}

DOVETAIL_INLINE_OCCT double occt_model::face_curvature(local_id f, vec2 uv) const {
  return occt::query("face", f, [&] { return own_->surface(f).curvature(uv); });
}

DOVETAIL_INLINE_OCCT vec2 occt_model::project_to_face(local_id f, vec3 p, vec2 seed) const {
  return occt::query("face", f, [&] { return own_->surface(f).project(p, seed); });
}

DOVETAIL_INLINE_OCCT double occt_model::project_to_curve(local_id c, vec3 p, double seed) const {
  const auto& curve = topology_->curves[c];
  if (curve.degenerate)
    return std::clamp(seed, curve.t[0], curve.t[1]);
  return occt::query("curve", c, [&] { return occt::nearest_parameter(own_->curve(c), curve.t, p, seed); });
}

DOVETAIL_INLINE_OCCT std::optional<double> occt_model::volume() const {
  try {
    constexpr double relative_error = 1e-6; // a tenth of it takes twice as long
    double sum = 0;
    for (const TopoDS_Solid& solid : data_->solids)
      sum += std::abs(occt::volume_of(solid, relative_error));
    return sum;
  } catch (const Standard_Failure&) {
    return std::nullopt;
  }
}

DOVETAIL_INLINE_OCCT std::optional<surface_frame> occt_model::plane_of_face(local_id f) const {
  constexpr double in_plane = 1e-6; // of the diagonal: the least tolerance that CAD files state
  if (own_->surface(f).adaptor().GetType() != GeomAbs_Plane)
    return std::nullopt;
  for (const auto& coedge : topology_->faces[f].coedges)
    if (topology_->curves[coedge.curve].tolerance > in_plane * bounds_.diagonal())
      return std::nullopt;
  return own_->surface(f).frame({0, 0});
}

DOVETAIL_INLINE_OCCT occt_read_result occt_model_from(occt::attributed_shape input, occt::wanted what,
                                                      const std::optional<double>& join_within) {
  const stopwatch watch;
  const std::string source = input.source;
  dovetail::report made;
  made.name = "geometry";
  const occt::silenced quiet;
  bool joined = false;
  occt::brep data = occt::guarded(source, [&] {
    occt::brep healed = occt::healed_brep(input, made, what);
    joined = join_within && occt::join_touching_faces(input, healed, made, what, *join_within);
    return healed;
  });
  made.warnings.insert(made.warnings.end(), data.warnings.begin(), data.warnings.end());
  made.set(occt::shape_counts{.solids = data.topology.solids.size(),
                              .faces = data.topology.faces.size(),
                              .curves = data.topology.curves.size(),
                              .vertices = data.topology.vertices.size()});
  occt_model model(std::move(data));
  made.seconds = watch.seconds();
  return {std::move(model), std::move(made), joined};
}

DOVETAIL_INLINE_OCCT occt_read_result occt_shape_from(const TopoDS_Shape& shape, std::string name,
                                                      occt::wanted what) {
  occt::attributed_shape input;
  input.shape = shape;
  input.source = std::move(name);
  return occt_model_from(std::move(input), what);
}

DOVETAIL_INLINE_OCCT bool is_occt_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(occt::head_size, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  return occt::format_of_content(head) != occt::file_format::unknown;
}

DOVETAIL_INLINE_OCCT occt_read_result read_occt_model(const std::filesystem::path& path,
                                                      occt_read_options options) {
  const occt::memory_watch memory;
  try {
    return occt_model_from(occt::read_shape(path, options), options.entities, options.join_within);
  } catch (const input_error&) {
    memory.throw_if_short();
    throw;
  } catch (const geometry_error&) {
    memory.throw_if_short();
    throw;
  }
}

#ifdef DOVETAIL_COMPILED_OCCT
template any_geometry::any_geometry(occt_model);
#endif

} // namespace dovetail
