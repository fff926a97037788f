/// @file
/// The second half of a bi-division: triangles that span the loops of a cut.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/experiments/baselines/recursive_bisection/surface_cut.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/remesh/surface_region.hpp"
#include "dovetail/remesh/surfaces.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::baselines {

/// Triangles that span loops, seen from above counter-clockwise.
struct spanning_surface {
  std::vector<vec3> inner_points;    ///< by number, after those of the loops
  std::vector<simplex<2>> triangles; ///< of the surface's points, the inner ones behind these
};

namespace detail {

/// Gives inner points the height over the plane that is the mean of their neighbours': the surface of least
/// tension, about, over loops that leave the plane by an edge or so.
inline void relax_heights(std::vector<double>& heights, std::size_t fixed,
                          const std::vector<simplex<2>>& triangles) {
  std::vector<std::vector<local_id>> neighbours(heights.size());
  for (const auto& triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      neighbours[triangle[k]].push_back(triangle[(k + 1) % 3]);
  constexpr int sweeps = 100; // what loops do at their wave length dies out within a few edges
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t v = fixed; v < heights.size(); ++v) {
      double sum = 0;
      for (const local_id w : neighbours[v])
        sum += heights[w];
      if (!neighbours[v].empty())
        heights[v] = sum / static_cast<double>(neighbours[v].size());
    }
}

} // namespace detail

/// Projects the loops onto the plane, triangulates what is inside them with sides that no triangle of the
/// surface has, in the sizes asked for, and lifts the points inside to where the loops are. Nothing where
/// loops cross in the plane, or lie in one another the wrong way round. Costs what a region of the surface
/// mesher does.
inline std::optional<spanning_surface> span_loops(const simplicial_mesh<2>& surface,
                                                  const side_table<2>& table, const surface_cut& cut,
                                                  const cut_plane& plane, const any_surface_mesher& mesher,
                                                  const any_sizing& size) {
  const vec3 n = plane.normal;
  const vec3 across = std::abs(n.x) < 0.6 ? vec3{1, 0, 0} : vec3{0, 1, 0};
  const vec3 x = normalized(cross(across, n));
  const remesh::plane_surface flat{plane.offset * n, x, cross(n, x)};
  std::vector<local_id> on_loops; // the points of the boundary, growing
  for (const auto& edge : cut.loops)
    on_loops.push_back(edge[0]);
  sort_unique(on_loops);
  const auto number = [&](local_id v) {
    const auto at = std::lower_bound(on_loops.begin(), on_loops.end(), v);
    return at != on_loops.end() && *at == v ? static_cast<local_id>(at - on_loops.begin()) : no_id;
  };

  surface_region region;
  region.surface = any_surface::holding(flat);
  region.surface.plane = flat;
  patch_boundary& boundary = region.boundary;
  std::vector<double> heights;
  for (const local_id v : on_loops) {
    const vec3 p = surface.points[v];
    const vec2 uv = flat.project(p);
    boundary.labels.push_back(static_cast<local_id>(boundary.labels.size()));
    boundary.uv.push_back(uv);
    boundary.points.push_back(flat.frame(uv).point);
    heights.push_back(dot(p, n) - plane.offset);
  }
  for (const auto& [a, b] : cut.loops)
    boundary.segments.push_back({number(a), number(b)});
  std::set<std::array<local_id, 2>> segments;
  for (const auto& [a, b] : boundary.segments)
    segments.insert({std::min(a, b), std::max(a, b)});
  for (const auto& side : table.vertices)
    if (const local_id a = number(side[0]), b = number(side[1]); a != no_id && b != no_id)
      if (!segments.contains({std::min(a, b), std::max(a, b)}))
        boundary.forbidden_edges.push_back({a, b});

  const patch_mesh made = mesh_region(mesher, region.surface, region, size, {});
  if (!made.ok() || made.triangles.empty())
    return std::nullopt;
  const std::size_t fixed = heights.size();
  heights.resize(fixed + made.inner_points.size(), 0.0);
  detail::relax_heights(heights, fixed, made.triangles);
  spanning_surface result;
  for (std::size_t k = 0; k < made.inner_points.size(); ++k)
    result.inner_points.push_back(made.inner_points[k] + heights[fixed + k] * n);
  for (simplex<2> triangle : made.triangles) {
    for (local_id& v : triangle)
      v = static_cast<std::size_t>(v) < fixed
              ? on_loops[v]
              : static_cast<local_id>(surface.points.size()) + v - static_cast<local_id>(fixed);
    result.triangles.push_back(triangle);
  }
  return result;
}

/// The least dihedral between a spanning surface and the triangles at its loops, in degrees; negative where
/// it leaves the solid. O(loops log loops) and linear in its triangles.
inline double least_dihedral_at_loops(const simplicial_mesh<2>& surface, const surface_cut& cut,
                                      const spanning_surface& spanning) {
  std::map<std::array<local_id, 2>, local_id> apex; // of the triangle that has this edge on its left
  for (const auto& t : spanning.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      apex[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  const auto at = [&](local_id v) {
    const auto i = static_cast<std::size_t>(v);
    return i < surface.points.size() ? surface.points[i] : spanning.inner_points[i - surface.points.size()];
  };
  const auto apex_of = [&](local_id triangle, const std::array<local_id, 2>& edge) {
    for (const local_id v : surface.elements[triangle])
      if (v != edge[0] && v != edge[1])
        return v;
    return no_id;
  };
  double least = 360;
  for (std::size_t k = 0; k < cut.loops.size(); ++k) {
    const auto& edge = cut.loops[k];
    const auto found = apex.find(edge);
    if (found == apex.end())
      return -360;
    // Angles around the edge through the solid, from the triangle below, which has the edge backwards.
    const vec3 a = at(edge[1]), along = normalized(at(edge[0]) - a);
    const auto away = [&](local_id v) {
      const vec3 to = at(v) - a;
      return to - dot(to, along) * along;
    };
    const vec3 start = normalized(away(apex_of(cut.beside[k][0], edge)));
    const vec3 inwards = cross(start, along); // the triangle's normal, outwards, is along x start
    const auto angle = [&](local_id v) {
      const vec3 to = away(v);
      const double turned = std::atan2(dot(to, inwards), dot(to, start)) * 180 / std::numbers::pi;
      return turned < 0 ? turned + 360 : turned;
    };
    const double between = angle(found->second);
    const double whole = angle(apex_of(cut.beside[k][1], edge));
    least = std::min({least, between, whole - between});
  }
  return least;
}

} // namespace dovetail::baselines
