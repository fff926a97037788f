/// @file
/// What `adapt.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/geometry/curved_model.hpp"
#include "dovetail/geometry/mesh_boundary.hpp"
#include "dovetail/io/gather.hpp"
#include "dovetail/mesh/point_neighbours.hpp"
#include "dovetail/pipeline/adapt.hpp"
#include "dovetail/sizing/background.hpp"

#include <algorithm>
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

} // namespace detail

template <int D>
boundary_model<D> model_of_boundary(const adaptable_mesh<D>& old, double feature_angle_deg) {
  mesh_boundary boundary;
  if constexpr (D == 3)
    boundary = boundary_of(old.mesh, old.sides, old.side_ids);
  else
    boundary.surfaces = surface_of(old.mesh, old.sides, old.side_ids);
  const curved_model model(boundary.surfaces,
                           {.feature_angle_deg = feature_angle_deg, .allow_sheets = D == 2});
  boundary_model<D> made{
      model, {}, std::move(boundary.material_of_solid), std::move(boundary.surfaces.repairs.warnings)};
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

namespace detail {

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

template <int D>
adapted<D> mesh_again(boundary_model<D> boundary, const erased_sizing& size, const any_parameters<D>& given) {
  adapted<D> made{
      generate_from_background<D>(boundary.model, make_background<D>(boundary.model, size, given), given),
      std::move(boundary.model), std::move(boundary.id_of_face), std::move(boundary.material_of_solid),
      std::move(boundary.id_of_curve)};
  append(made.summary.warnings, boundary.warnings);
  return made;
}

template <int D>
adaptable_mesh<D> whole_mesh(const adapted<D>& made) {
  io::gathered_mesh<D> whole = io::gather(made.mesh);
  const auto replace = [](std::vector<local_id>& numbers, const std::vector<local_id>& by) {
    for (local_id& n : numbers)
      n = by[static_cast<std::size_t>(n)];
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
template erased_sizing sizes_at_points(const simplicial_mesh<2>&, std::vector<double>, double);
template erased_sizing sizes_at_points(const simplicial_mesh<3>&, std::vector<double>, double);
template adapted<2> mesh_again(boundary_model<2>, const erased_sizing&, const any_parameters<2>&);
template adapted<3> mesh_again(boundary_model<3>, const erased_sizing&, const any_parameters<3>&);
template adaptable_mesh<2> whole_mesh(const adapted<2>&);
template adaptable_mesh<3> whole_mesh(const adapted<3>&);
#endif

} // namespace dovetail
