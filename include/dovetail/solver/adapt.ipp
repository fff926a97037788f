/// @file
/// What `adapt.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/point_neighbours.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/models/curved_model.hpp"
#include "dovetail/models/discrete/given_mesh_checks.hpp"
#include "dovetail/models/discrete/mesh_boundary.hpp"
#include "dovetail/pipeline/only.hpp"
#include "dovetail/sizing/background.hpp"
#include "dovetail/solver/adapt.hpp"
#include "dovetail/solver/gather.hpp"
#include "dovetail/solver/names_on_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The id of the edges that make up a curve: all its segments are asked for, so that all are met.
inline local_id id_along(const discrete_model& model, local_id curve, edge_ids& ids) {
  const auto lengths = model.lengths_along(curve);
  local_id id = no_id;
  for (std::size_t k = 1; k < lengths.size(); ++k)
    id = std::max(id, ids.at(model.curve_point(curve, 0.5 * (lengths[k - 1] + lengths[k]))));
  return id;
}

inline double area_of(const std::vector<vec3>& points, const simplex<2>& triangle) {
  const auto at = [&](std::size_t k) { return points[triangle[k]]; };
  return 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)));
}

/// What a smooth surface through the points of a triangulated one has more: of volume behind it, and of area.
/// Between triangles with the edge h that turn by the angle a the surface is 0.2165 h a above them, which is
/// exact for equilateral ones on a sphere, and grows by 0.625 a^2 of their area. Sharp edges are edges.
struct chord_gaps {
  double volume = 0, area = 0;
};
inline chord_gaps gaps_of(const simplicial_mesh<2>& surface, double feature_angle_deg) {
  chord_gaps gaps;
  const auto sides = build_sides(surface);
  const auto at = [&](local_id v) { return surface.points[v]; };
  const auto normal = [&](local_id t) {
    const auto& [a, b, c] = surface.elements[t];
    return cross(at(b) - at(a), at(c) - at(a));
  };
  const auto centre = [&](local_id t) {
    const auto& [a, b, c] = surface.elements[t];
    return (at(a) + at(b) + at(c)) / 3.0;
  };
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (!sides.is_interior(static_cast<local_id>(s)))
      continue;
    const auto [t, u] = sides.elements[s];
    const vec3 n = normal(t), m = normal(u);
    const double turn = angle_between(n, m);
    if (!(turn * degrees_per_radian < feature_angle_deg))
      continue;
    const bool convex = dot(n, centre(u) - centre(t)) < 0;
    const double area = 0.5 * (norm(n) + norm(m)) / 3;
    const double height = 0.2165 * turn * distance(at(sides.vertices[s][0]), at(sides.vertices[s][1]));
    gaps.volume += (convex ? area : -area) * height;
    gaps.area += 0.625 * turn * turn * area;
  }
  return gaps;
}

inline mesh_extent extent_of(const adaptable_mesh<3>& old, const oriented_surfaces& surfaces,
                             double feature_angle_deg) {
  mesh_extent extent;
  const auto at = [&](local_id v) { return old.mesh.points[v]; };
  for (const auto& [a, b, c, d] : old.mesh.elements)
    extent.volume += signed_volume(at(a), at(b), at(c), at(d));
  simplicial_mesh<2> outer{surfaces.mesh.points, {}, {}};
  for (std::size_t t = 0; t < surfaces.mesh.elements.size(); ++t) {
    extent.area += area_of(surfaces.mesh.points, surfaces.mesh.elements[t]);
    if (surfaces.front_of[t] == no_id)
      outer.elements.push_back(surfaces.mesh.elements[t]);
  }
  extent.chord_gap = gaps_of(outer, feature_angle_deg).volume;
  return extent;
}
inline mesh_extent extent_of(const simplicial_mesh<2>& mesh, double feature_angle_deg) {
  mesh_extent extent;
  for (const auto& triangle : mesh.elements)
    extent.area += area_of(mesh.points, triangle);
  extent.chord_gap = gaps_of(mesh, feature_angle_deg).area;
  return extent;
}
/// By the skeleton alone: no piece is loaded.
inline mesh_extent extent_of(const distributed_simplicial_mesh<3>& mesh, double feature_angle_deg) {
  mesh_extent extent;
  const auto& skeleton = mesh.skeleton;
  simplicial_mesh<2> outer;
  outer.points.assign(skeleton.points.begin(), skeleton.points.end());
  for (std::size_t s = 0; s < skeleton.sides.size(); ++s) {
    if (skeleton.side_hosts[s] != no_id)
      extent.area += area_of(outer.points, skeleton.sides[s]);
    if (skeleton.subdomains[s][1] == no_id)
      outer.elements.push_back(skeleton.sides[s]);
  }
  extent.volume = enclosed_volume(span_of(outer.points), span_of(outer.elements));
  extent.chord_gap = gaps_of(outer, feature_angle_deg).volume;
  return extent;
}
inline mesh_extent extent_of(const distributed_simplicial_mesh<2>& mesh, double feature_angle_deg) {
  mesh_extent extent;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    if (mesh.counts[p].elements > 0) { // else it failed
      const mesh_extent of_piece = extent_of(mesh.load(static_cast<local_id>(p)).mesh, feature_angle_deg);
      extent.area += of_piece.area;
      extent.chord_gap += of_piece.chord_gap;
    }
  return extent;
}

/// What adaptation did to the extent of a mesh.
struct extent_counts {
  std::optional<double> volume_before = {};
  std::optional<double> volume_after = {};
  double area_before = 0;
  double area_after = 0;
  double explained_change = 0; ///< by chords of other lengths

  using fields =
      field_list<&extent_counts::volume_before, &extent_counts::volume_after, &extent_counts::area_before,
                 &extent_counts::area_after, &extent_counts::explained_change>;
};

/// The part of the report, with a warning where the mesh has another size than chords explain.
template <int D>
report change_of_extent(const mesh_extent& before, const mesh_extent& after, bool on_model) {
  report change;
  change.name = "adaptation";
  const double explained = before.chord_gap - after.chord_gap;
  change.set(extent_counts{.volume_before = D == 3 ? std::optional(before.volume) : std::nullopt,
                           .volume_after = D == 3 ? std::optional(after.volume) : std::nullopt,
                           .area_before = before.area,
                           .area_after = after.area,
                           .explained_change = explained});
  const double was = D == 3 ? before.volume : before.area, is = D == 3 ? after.volume : after.area;
  const double rounding = 0.3 * (std::abs(before.chord_gap) + std::abs(after.chord_gap)) + 5e-4 * was;
  if (std::abs(is - was - explained) > rounding)
    change.warnings.push_back(
        std::string(D == 3 ? "the volume" : "the area") + " was " + number_text(was) + " and is " +
        number_text(is) + ", " + number_text(100 * (is / was - 1), 2) +
        " %, where chords of these sizes explain " + number_text(100 * explained / was, 2) + " %; " +
        (on_model ? "" : "adapt on the model, or ") + "take smaller sizes where it is curved");
  return change;
}

} // namespace detail

template <int D>
boundary_model<D> model_of_boundary(const adaptable_mesh<D>& old, double feature_angle_deg) {
  mesh_boundary boundary;
  mesh_extent before;
  if constexpr (D == 3) {
    boundary = boundary_of(old.mesh, old.sides, old.side_ids);
    before = detail::extent_of(old, boundary.surfaces, feature_angle_deg);
  } else {
    boundary.surfaces = surface_of(old.mesh, old.sides, old.side_ids);
    before = detail::extent_of(old.mesh, feature_angle_deg);
  }
  const curved_model model(boundary.surfaces,
                           {.feature_angle_deg = feature_angle_deg, .allow_sheets = D == 2});
  boundary_model<D> made{
      model, {}, std::move(boundary.material_of_solid), std::move(boundary.surfaces.repairs.warnings)};
  made.before = before;
  for (std::size_t f = 0; f < model.topology().faces.size(); ++f)
    made.id_of_face.push_back(model.face_id(static_cast<local_id>(f)));
  if constexpr (D == 2) {
    edge_ids ids(old.mesh.points, old.sides, old.side_ids);
    for (std::size_t c = 0; c < model.topology().curves.size(); ++c)
      made.id_of_curve.push_back(detail::id_along(model.flat(), static_cast<local_id>(c), ids));
    if (const std::size_t missed = ids.missed(); missed > 0)
      made.warnings.push_back(std::to_string(missed) + " edges with ids are neither on the boundary nor at a "
                                                       "feature; the adapted mesh knows nothing of them");
  }
  return made;
}

template <int D>
boundary_model<D> model_of_mesh(const any_geometry& model, const adaptable_mesh<D>& old) {
  constexpr double feature_angle_deg = adaptation_options{}.feature_angle_deg;
  boundary_model<D> made{model, {}, {}, {}};
  if constexpr (D == 3) {
    made.named_by = boundary_of(old.mesh, old.sides, old.side_ids);
    made.before = detail::extent_of(old, made.named_by->surfaces, feature_angle_deg);
    made.warnings = made.named_by->surfaces.repairs.warnings;
  } else {
    detail::require_boundary_to_find(old.mesh);
    detail::require_ids<1>(old.mesh.points, old.sides, old.side_ids, "edge");
    made.named_by = old;
    made.before = detail::extent_of(old.mesh, feature_angle_deg);
  }
  return made;
}

namespace detail {

template <int D>
void name_entities(boundary_model<D>& boundary, const surface_mesh& coarse) {
  model_names names;
  if constexpr (D == 3)
    names = names_on_model(boundary.model, coarse, *boundary.named_by);
  else
    names = names_on_model(boundary.model, coarse, boundary.named_by->mesh, boundary.named_by->sides,
                           boundary.named_by->side_ids);
  boundary.id_of_face = std::move(names.id_of_face);
  boundary.material_of_solid = std::move(names.material_of_solid);
  boundary.id_of_curve = std::move(names.id_of_curve);
  append(boundary.warnings, names.warnings);
}

/// Makes sizes smaller until none grows by more than `growth` per length along an edge, smallest first, as
/// in Dijkstra's algorithm.
template <int D>
void limit_growth(const simplicial_mesh<D>& mesh, std::vector<double>& sizes, double growth) {
  sizing::checked_size(growth, "the growth of the sizes");
  const auto neighbours = point_neighbours(mesh);
  using entry = std::pair<double, local_id>;
  std::priority_queue<entry, std::vector<entry>, std::greater<>> pending;
  for (std::size_t v = 0; v < sizes.size(); ++v)
    pending.push({sizes[v], static_cast<local_id>(v)});
  while (!pending.empty()) {
    const auto [size, v] = pending.top();
    pending.pop();
    const auto at = static_cast<std::size_t>(v);
    if (size > sizes[at])
      continue;
    for (const local_id w : neighbours[at]) {
      const auto next = static_cast<std::size_t>(w);
      const double most = size + growth * distance(mesh.points[at], mesh.points[next]);
      if (most < sizes[next]) {
        sizes[next] = most;
        pending.push({most, w});
      }
    }
  }
}

} // namespace detail

template <int D>
erased_sizing sizes_at_points(const simplicial_mesh<D>& mesh, std::vector<double> sizes, double growth) {
  if (sizes.size() != mesh.points.size())
    throw sizing_error("the mesh has " + std::to_string(mesh.points.size()) + " points and there are " +
                       std::to_string(sizes.size()) + " sizes; give one size per point");
  for (std::size_t v = 0; v < sizes.size(); ++v)
    sizing::checked_size(sizes[v], "the size at point " + std::to_string(v));
  detail::limit_growth(mesh, sizes, growth);
  return erased_sizing(background_field(mesh, std::move(sizes)));
}

template <int D, bound_parameters<D> Parameters>
adapted<D> mesh_again(boundary_model<D> boundary, const erased_sizing& size, const Parameters& given) {
  detail::refuse_only(given.options, "an adaptation");
  auto background = make_background<D>(boundary.model, size, given);
  if (boundary.named_by)
    detail::name_entities(boundary, background.mesh.surface);
  adapted<D> made{generate_from_background<D>(boundary.model, std::move(background), given),
                  std::move(boundary.model), std::move(boundary.id_of_face),
                  std::move(boundary.material_of_solid), std::move(boundary.id_of_curve)};
  append(made.summary.warnings, boundary.warnings);
  if (made.failures.empty())
    made.summary.children.push_back(detail::change_of_extent<D>(
        boundary.before, detail::extent_of(made.mesh, adaptation_options{}.feature_angle_deg),
        boundary.named_by.has_value()));
  return made;
}

template <int D>
adaptable_mesh<D> whole_mesh(const adapted<D>& made) {
  io::gathered_mesh<D> whole = io::gather(made.mesh);
  const auto replace = [](std::vector<local_id>& numbers, const std::vector<local_id>& by) {
    for (local_id& n : numbers)
      n = by[n];
  };
  replace(whole.side_hosts, D == 3 ? made.id_of_face : made.id_of_curve);
  adaptable_mesh<D> result{.mesh = std::move(whole.mesh), .subdomains = std::move(whole.subdomains)};
  if constexpr (D == 3) {
    replace(result.mesh.tags, made.material_of_solid);
  } else {
    replace(result.mesh.tags, made.id_of_face);
  }
  result.sides = std::move(whole.sides);
  result.side_ids = std::move(whole.side_hosts);
  return result;
}

#ifdef DOVETAIL_COMPILED
template boundary_model<2> model_of_boundary(const adaptable_mesh<2>&, double);
template boundary_model<3> model_of_boundary(const adaptable_mesh<3>&, double);
template boundary_model<2> model_of_mesh(const any_geometry&, const adaptable_mesh<2>&);
template boundary_model<3> model_of_mesh(const any_geometry&, const adaptable_mesh<3>&);
template erased_sizing sizes_at_points(const simplicial_mesh<2>&, std::vector<double>, double);
template erased_sizing sizes_at_points(const simplicial_mesh<3>&, std::vector<double>, double);
template adapted<2> mesh_again(boundary_model<2>, const erased_sizing&, const any_parameters<2>&);
template adapted<3> mesh_again(boundary_model<3>, const erased_sizing&, const any_parameters<3>&);
template adaptable_mesh<2> whole_mesh(const adapted<2>&);
template adaptable_mesh<3> whole_mesh(const adapted<3>&);
#endif

} // namespace dovetail
