/// @file
/// `occt_model`: a B-rep of Open CASCADE as a `geometry_model`.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/geometry/occt_bounds.hpp"
#include "dovetail/geometry/occt_heal.hpp"
#include "dovetail/geometry/occt_read.hpp"
#include "dovetail/geometry/occt_topology.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace dovetail {

/// A CAD model of one or several solids, or of faces alone. Models `geometry_model`.
///
/// Evaluation fills caches inside, so one object serves one thread; copies are independent of each other and
/// cheap (they share the topology and OCCT's geometry), so give each thread a copy.
class occt_model {
public:
  /// `data` must be without faults; made by `occt_model_from` or `read_occt_model`.
  explicit occt_model(occt::brep data)
      : data_(std::make_shared<const occt::brep>(std::move(data))), curves_(data_->curves),
        surfaces_(data_->surfaces), coedges_(data_->coedges), bounds_(occt::bounds_of(*data_)) {}

  occt_model(const occt_model& other)
      : data_(other.data_), curves_(other.curves_), surfaces_(other.surfaces_), coedges_(other.coedges_),
        bounds_(other.bounds_) {
    renew_caches();
  }
  occt_model(occt_model&&) = default;
  occt_model& operator=(const occt_model& other) { return *this = occt_model(other); }
  occt_model& operator=(occt_model&&) = default;
  ~occt_model() = default;

  const geometry_topology& topology() const { return data_->topology; }
  const TopoDS_Shape& shape() const { return data_->shape; }
  const occt::brep& data() const { return *data_; }
  box3 bounds() const { return bounds_; }
  bool thread_safe() const { return false; }

  vec3 curve_point(local_id c, double t) const {
    if (topology().curves[index(c)].degenerate)
      return pole(c);
    return query("curve", c, [&] { return occt::to_vec3(curves_[index(c)].Value(t)); });
  }
  dovetail::curve_frame curve_frame(local_id c, double t) const {
    if (topology().curves[index(c)].degenerate)
      return {pole(c), {}};
    return query("curve", c, [&] {
      gp_Pnt p;
      gp_Vec d;
      curves_[index(c)].D1(t, p, d);
      return dovetail::curve_frame{occt::to_vec3(p), occt::to_vec3(d.XYZ())};
    });
  }
  vec2 curve_uv(local_id f, int k, double t) const {
    return query("face", f,
                 [&] { return coedges_[index(f)][static_cast<std::size_t>(k)].at(t, surfaces_[index(f)]); });
  }
  vec3 face_point(local_id f, vec2 uv) const {
    return query("face", f, [&] { return surfaces_[index(f)].point(uv); });
  }
  surface_frame face_frame(local_id f, vec2 uv) const {
    return query("face", f, [&] { return surfaces_[index(f)].frame(uv); });
  }
  double face_curvature(local_id f, vec2 uv) const {
    return query("face", f, [&] { return surfaces_[index(f)].curvature(uv); });
  }
  vec2 project_to_face(local_id f, vec3 p, vec2 seed) const {
    return query("face", f, [&] { return surfaces_[index(f)].project(p, seed); });
  }

  /// The plane that a face lies in, if all its curves are in it too; meshers then evaluate it themselves.
  std::optional<surface_frame> plane_of_face(local_id f) const {
    if (surfaces_[index(f)].adaptor().GetType() != GeomAbs_Plane)
      return std::nullopt;
    for (const auto& coedge : topology().faces[index(f)].coedges)
      if (topology().curves[index(coedge.curve)].tolerance > in_plane * bounds_.diagonal())
        return std::nullopt;
    return surfaces_[index(f)].frame({0, 0});
  }

  /// Damped Newton from the seed, kept in the curve's range.
  double project_to_curve(local_id c, vec3 p, double seed) const {
    const auto& range = topology().curves[index(c)].t;
    if (topology().curves[index(c)].degenerate)
      return std::clamp(seed, range[0], range[1]);
    return query("curve", c, [&] { return nearest_parameter(curves_[index(c)], range, p, seed); });
  }

private:
  static constexpr double in_plane = 1e-6; // of the diagonal: the least tolerance that CAD files state

  static std::size_t index(local_id id) { return static_cast<std::size_t>(id); }

  vec3 pole(local_id c) const {
    return topology().vertices[index(topology().curves[index(c)].vertices[0])].point;
  }

  template <class Query>
  static auto query(const char* kind, local_id id, Query&& evaluate) -> decltype(evaluate()) {
    try {
      return evaluate();
    } catch (const Standard_Failure& failure) {
      throw geometry_error(std::string(kind) + " " + std::to_string(id) +
                           " cannot be evaluated: " + failure.GetMessageString());
    }
  }

  static double nearest_parameter(const GeomAdaptor_Curve& curve, const std::array<double, 2>& range, vec3 p,
                                  double t) {
    const double width = range[1] - range[0];
    t = std::clamp(t, range[0], range[1]);
    for (int step = 0; step < 40; ++step) {
      gp_Pnt q;
      gp_Vec first, second;
      curve.D2(t, q, first, second);
      const vec3 r = occt::to_vec3(q) - p, d1 = occt::to_vec3(first.XYZ()), d2 = occt::to_vec3(second.XYZ());
      const double slope = dot(r, d1), gauss = dot(d1, d1), hessian = gauss + dot(r, d2);
      if (!(gauss > 0))
        return t;
      const double direction = -slope / (hessian > 1e-3 * gauss ? hessian : gauss);
      double next = std::clamp(t + direction, range[0], range[1]);
      const double value = dot(r, r);
      for (int halving = 0; halving < 20; ++halving) {
        if (norm_squared(occt::to_vec3(curve.Value(next)) - p) <= value)
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

  void renew_caches() {
    for (std::size_t c = 0; c < curves_.size(); ++c)
      if (!topology().curves[c].degenerate)
        curves_[c] = GeomAdaptor_Curve(curves_[c].Curve());
    for (auto& surface : surfaces_)
      surface = surface.independent_copy();
    for (auto& face : coedges_)
      for (auto& coedge : face)
        coedge = coedge.independent_copy();
  }

  std::shared_ptr<const occt::brep> data_;
  std::vector<GeomAdaptor_Curve> curves_;
  std::vector<occt::face_surface> surfaces_;
  std::vector<std::vector<occt::coedge_curve>> coedges_;
  box3 bounds_;
};
static_assert(geometry_model<occt_model>);

/// A model and what was found and done while making it.
struct occt_read_result {
  occt_model model;
  dovetail::report report;
};

/// Turns a shape into a model, healing as far as needed. Throws `geometry_error` naming the first entity that
/// cannot be meshed.
inline occt_read_result occt_model_from(occt::attributed_shape input,
                                        occt::wanted what = occt::wanted::solids) {
  const stopwatch watch;
  const std::string source = input.source;
  dovetail::report made;
  made.name = "geometry";
  const occt::silenced quiet;
  occt::brep data = occt::guarded(source, [&] { return occt::healed_brep(std::move(input), made, what); });
  made.warnings.insert(made.warnings.end(), data.warnings.begin(), data.warnings.end());
  made.set("solids", static_cast<double>(data.topology.solids.size()));
  made.set("faces", static_cast<double>(data.topology.faces.size()));
  made.set("curves", static_cast<double>(data.topology.curves.size()));
  made.set("vertices", static_cast<double>(data.topology.vertices.size()));
  occt_model model(std::move(data));
  made.seconds = watch.seconds();
  return {std::move(model), std::move(made)};
}

/// The same for a shape made by the caller's own OCCT code. The shape may be changed by healing.
inline occt_read_result occt_shape_from(const TopoDS_Shape& shape, std::string name = "shape",
                                        occt::wanted what = occt::wanted::solids) {
  occt::attributed_shape input;
  input.shape = shape;
  input.source = std::move(name);
  return occt_model_from(std::move(input), what);
}

struct occt_read_options {
  occt::length_unit unit = occt::length_unit::millimetre;
  /// For D = 2, `faces`: also open shells and single faces, such as a plane domain with holes and inner
  /// edges.
  occt::wanted entities = occt::wanted::solids;
};

/// Reads a STEP, IGES or BREP file. Throws `input_error` for a file that is missing, empty, truncated or
/// foreign, `geometry_error` for a shape that cannot be meshed.
inline occt_read_result read_occt_model(const std::filesystem::path& path, occt_read_options options = {}) {
  return occt_model_from(occt::read_shape(path, options.unit), options.entities);
}

} // namespace dovetail
