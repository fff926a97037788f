/// @file
/// What every improver has to respect on meshes of triangles, as checks before and after; and meshes to try.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/validity.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <vector>

namespace surface_checks {

using dovetail::local_id;
using dovetail::simplex;
using dovetail::vec2;
using dovetail::vec3;
using triangle_mesh = dovetail::simplicial_mesh<2>;
using frozen_edges = dovetail::frozen_entities<2>;
/// An edge by its coordinates, so that renumbering of points does not matter.
using placed_edge = std::array<std::array<double, 3>, 2>;

inline placed_edge place(const triangle_mesh& mesh, std::array<local_id, 2> v) {
  placed_edge edge;
  for (std::size_t k = 0; k < 2; ++k) {
    const vec3 p = mesh.points[v[k]];
    edge[k] = {p.x, p.y, p.z};
  }
  std::sort(edge.begin(), edge.end());
  return edge;
}

/// Edges with other than two triangles, and those between two tags.
inline std::set<placed_edge> fixed_edges(const triangle_mesh& mesh) {
  const auto sides = dovetail::build_sides(mesh);
  std::set<placed_edge> result;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [t, u] = sides.elements[s];
    if (!sides.is_interior(static_cast<local_id>(s)) || (!mesh.tags.empty() && mesh.tags[t] != mesh.tags[u]))
      result.insert(place(mesh, sides.vertices[s]));
  }
  return result;
}
inline std::set<placed_edge> all_edges(const triangle_mesh& mesh) {
  std::set<placed_edge> result;
  for (const auto& side : dovetail::build_sides(mesh).vertices)
    result.insert(place(mesh, side));
  return result;
}

/// Triangles that do not turn left seen from above, exactly.
inline std::size_t turned_over(const triangle_mesh& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.elements.begin(), mesh.elements.end(), [&](const simplex<2>& triangle) {
        const auto p = dovetail::corners(std::span(mesh.points), triangle);
        return dovetail::orient2d({p[0].x, p[0].y}, {p[1].x, p[1].y}, {p[2].x, p[2].y}) <= 0;
      }));
}
inline std::map<local_id, double> area_per_tag(const triangle_mesh& mesh) {
  std::map<local_id, double> areas;
  for (std::size_t t = 0; t < mesh.elements.size(); ++t) {
    const auto p = dovetail::corners(std::span(mesh.points), mesh.elements[t]);
    areas[mesh.tags.empty() ? 0 : mesh.tags[t]] += 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
  }
  return areas;
}

/// Checks all that the concept promises of a change of a valid mesh.
/// (A removed point before a frozen one leaves a number that nothing can take.)
inline void check_change(const triangle_mesh& before, const triangle_mesh& after,
                         const frozen_edges& frozen = {}) {
  const auto validity = dovetail::check_validity(
      after, {.closed_boundary = false, .non_manifold_sides = true, .isolated_points = true});
  CHECK_MESSAGE(validity.valid(), validity.text());
  CHECK(dovetail::measure_quality(after).min_dihedral_deg >=
        dovetail::measure_quality(before).min_dihedral_deg - 1e-6);
  CHECK(fixed_edges(after) == fixed_edges(before));
  const auto edges = all_edges(after);
  for (const auto& side : frozen.sides)
    CHECK(edges.count(place(before, side)) == 1);
  REQUIRE(after.points.size() >= static_cast<std::size_t>(frozen.points));
  for (std::size_t v = 0; v < static_cast<std::size_t>(frozen.points); ++v)
    CHECK(after.points[v] == before.points[v]);
  // Points of fixed edges keep their numbers even when the caller does not list them.
  const auto sides = dovetail::build_sides(before);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (!sides.is_interior(static_cast<local_id>(s)))
      for (const local_id v : sides.vertices[s])
        CHECK(after.points[v] == before.points[v]);
}

/// A jittered grid without its points near some random places: a plane mesh with holes, in two tags.
inline triangle_mesh holed_squares(int n, double jitter, std::uint64_t seed) {
  auto mesh = dovetail_test::jittered_squares(n, jitter, seed, 0);
  dovetail_test::random_numbers random(seed);
  std::vector<vec3> holes;
  for (int k = 0; k < 2; ++k)
    holes.push_back({0.2 + 0.6 * random.unit(), 0.2 + 0.6 * random.unit(), 0});
  triangle_mesh cut{mesh.points, {}, {}};
  for (const auto& triangle : mesh.elements) {
    const auto p = dovetail::corners(std::span(mesh.points), triangle);
    const vec3 middle = (p[0] + p[1] + p[2]) / 3;
    if (std::any_of(holes.begin(), holes.end(), [&](vec3 hole) { return distance(hole, middle) < 0.12; }))
      continue;
    cut.elements.push_back(triangle);
    cut.tags.push_back(middle.x + middle.y < 1 ? 7 : 3);
  }
  // Without the points that the holes have left alone.
  std::vector<local_id> number(cut.points.size(), dovetail::no_id);
  triangle_mesh kept{{}, cut.elements, cut.tags};
  for (auto& triangle : kept.elements)
    for (local_id& v : triangle) {
      local_id& name = number[v];
      if (name == dovetail::no_id) {
        name = static_cast<local_id>(kept.points.size());
        kept.points.push_back(cut.points[v]);
      }
      v = name;
    }
  return kept;
}

/// The plane mesh bent by `map`, a function of (x, y).
template <class Map>
triangle_mesh bent(triangle_mesh mesh, const Map& map) {
  for (vec3& p : mesh.points)
    p = map(p.x, p.y);
  return mesh;
}

/// A closed surface: the six sides of a cube as jittered grids, joined; pushed onto the unit sphere or not.
inline triangle_mesh closed_cube(int n, double jitter, std::uint64_t seed, bool onto_sphere) {
  std::map<std::array<long, 3>, local_id> known;
  triangle_mesh result;
  for (int side = 0; side < 6; ++side) {
    auto square = dovetail_test::jittered_squares(n, jitter, seed + static_cast<std::uint64_t>(side), 0);
    std::vector<local_id> number;
    for (std::size_t k = 0; k < square.points.size(); ++k) {
      vec3& p = square.points[k];
      const int i = static_cast<int>(k) % (n + 1), j = static_cast<int>(k) / (n + 1);
      const bool on_rim = i == 0 || j == 0 || i == n || j == n;
      const double x = on_rim ? 2.0 * i / n - 1 : 2 * p.x - 1, y = on_rim ? 2.0 * j / n - 1 : 2 * p.y - 1;
      const int axis = side / 2;
      const bool is_far = side % 2 == 1;
      vec3 q;
      q[axis] = is_far ? 1 : -1;
      q[(axis + 1) % 3] = is_far ? x : y;
      q[(axis + 2) % 3] = is_far ? y : x;
      const std::array<long, 3> key{std::lround(1e6 * q.x), std::lround(1e6 * q.y), std::lround(1e6 * q.z)};
      const auto [at, is_new] = known.emplace(key, static_cast<local_id>(result.points.size()));
      if (is_new)
        result.points.push_back(onto_sphere ? normalized(q) : q);
      number.push_back(at->second);
    }
    for (simplex<2> triangle : square.elements) {
      for (local_id& v : triangle)
        v = number[v];
      result.elements.push_back(triangle);
    }
  }
  return result;
}

} // namespace surface_checks
