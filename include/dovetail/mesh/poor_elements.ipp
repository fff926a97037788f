/// @file
/// What `poor_elements.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/boundary_at_edges.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/poor_elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::string_view name_of(poor_cause cause) {
  constexpr std::array<std::string_view, poor_causes> names{
      "angle of the model", "interface angle", "boundary triangle", "thin wall", "thin piece", "inside"};
  return names[static_cast<std::size_t>(cause)];
}

DOVETAIL_INLINE void poor_elements::merge(const poor_elements& other) {
  for (std::size_t k = 0; k < poor_causes; ++k) {
    bad[k] += other.bad[k];
    low[k] += other.low[k];
  }
  const auto rank = [](const poor_elements& one) {
    const vec3 p = one.thinnest_place;
    return std::tuple(one.thinnest_wall, p.x, p.y, p.z);
  };
  if (rank(other) < rank(*this)) {
    thinnest_wall = other.thinnest_wall;
    thinnest_place = other.thinnest_place;
  }
}

namespace detail {

/// Whether all vertices are on the piece's boundary.
inline bool has_no_vertex_inside(const mesh_piece& piece, const simplex<3>& element) {
  const auto shared = static_cast<local_id>(piece.skeleton_points.size());
  return std::all_of(element.begin(), element.end(), [&](local_id v) { return v < shared; });
}

/// The cause for one element, whose smallest angle is at its ridge `worst` and below a limit.
DOVETAIL_INLINE poor_cause cause_of(const mesh_piece& piece, const boundary_at_edges& boundary,
                                    const simplex<3>& element, std::size_t worst, double limit_deg) {
  const auto point = [&](local_id v) { return piece.mesh.points[v]; };
  const auto pick_edge = [&](std::size_t r) {
    const auto& edge = numbering::ridges<3>[r];
    return simplex<1>{element[edge[0]], element[edge[1]]};
  };
  const simplex<1> edge = pick_edge(worst);
  vec3 middle{};
  for (const local_id v : element)
    middle += 0.25 * point(v);
  const auto sector = boundary.sector_at(edge, point(edge[0]), point(edge[1]), middle);
  const auto is_beside_angle = [&] {
    return boundary.is_in_wedge(element) || boundary.is_across_corner(element);
  };
  if (sector.degrees < 2 * limit_deg)
    return sector.on_surface || is_beside_angle() ? poor_cause::model_angle : poor_cause::interface_angle;
  bool has_poor_side = false;
  for (const auto& local : numbering::sides<3>) {
    simplex<2> side;
    for (std::size_t k = 0; k < 3; ++k)
      side[k] = element[local[k]];
    if (boundary.smallest_angle(side) >= limit_deg)
      continue;
    if (boundary.is_in_corner(side))
      return poor_cause::model_angle;
    has_poor_side = true;
  }
  if (boundary.is_across_corner(element))
    return poor_cause::model_angle;
  if (has_poor_side)
    return poor_cause::boundary_triangle;
  if (boundary.is_in_wedge(element))
    return poor_cause::model_angle;
  if (boundary.is_in_wall(element))
    return poor_cause::thin_wall;
  return has_no_vertex_inside(piece, element) ? poor_cause::thin_piece : poor_cause::inside;
}

/// The height over the largest side: how thick a wall is where a tetrahedron spans it.
DOVETAIL_INLINE double least_height(const tetrahedron_parts& parts) {
  double largest = 0;
  for (const vec3 normal : parts.normals)
    largest = std::max(largest, norm(normal));
  return largest > 0 ? parts.six_volumes / largest : 0;
}

} // namespace detail

DOVETAIL_INLINE poor_elements find_poor_elements(const mesh_piece& piece, const fine_skeleton& skeleton,
                                                 std::span<const local_id> listed) {
  struct poor {
    std::size_t element, worst;
    double angle_deg;
  };
  std::vector<poor> found;
  const double least_cotangent = 1 / std::tan(low_dihedral_deg / degrees_per_radian);
  for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
    const detail::tetrahedron_parts parts(corners(span_of(piece.mesh.points), piece.mesh.elements[e]));
    std::size_t worst = 6;
    double cotangent = least_cotangent;
    for (std::size_t r = 0; r < 6; ++r)
      if (const auto [sine, cosine] = parts.dihedral(r); cosine > cotangent * sine) {
        worst = r;
        cotangent = sine > 0 ? cosine / sine : std::numeric_limits<double>::infinity();
      }
    if (worst < 6)
      found.push_back({e, worst, degrees_per_radian * std::atan2(1.0, cotangent)});
  }
  poor_elements result;
  if (found.empty())
    return result;
  std::vector<simplex<3>> elements;
  for (const poor& one : found)
    elements.push_back(piece.mesh.elements[one.element]);
  const detail::boundary_at_edges boundary(piece, skeleton, listed, elements, 2 * bad_dihedral_deg);
  for (const poor& one : found) {
    const simplex<3>& element = piece.mesh.elements[one.element];
    const bool is_bad = one.angle_deg < bad_dihedral_deg;
    const poor_cause cause =
        detail::cause_of(piece, boundary, element, one.worst, is_bad ? bad_dihedral_deg : low_dihedral_deg);
    const auto k = static_cast<std::size_t>(cause);
    ++result.low[k];
    if (!is_bad)
      continue;
    ++result.bad[k];
    if (cause != poor_cause::thin_wall || !detail::has_no_vertex_inside(piece, element))
      continue;
    const auto p = corners(span_of(piece.mesh.points), element);
    poor_elements wall;
    wall.thinnest_wall = detail::least_height(detail::tetrahedron_parts(p));
    wall.thinnest_place = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    result.merge(wall);
  }
  return result;
}

} // namespace dovetail
