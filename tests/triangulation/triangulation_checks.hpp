/// @file
/// What holds for every triangulation, and for every Delaunay triangulation.
#pragma once

#include "dovetail/triangulation/delaunay.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace dovetail_test {

using namespace dovetail;

template <int D>
double orientation(const corner_places<D>& p) {
  if constexpr (D == 2)
    return orient2d(*p[0], *p[1], *p[2]);
  else
    return orient3d(*p[0], *p[1], *p[2], *p[3]);
}
template <int D>
double sphere_side(const corner_places<D>& p, point_of<D> q) {
  if constexpr (D == 2)
    return in_circle(*p[0], *p[1], *p[2], q);
  else
    return in_sphere(*p[0], *p[1], *p[2], *p[3], q);
}
inline double measure(const corner_places<2>& p) {
  return cross(*p[1] - *p[0], *p[2] - *p[0]) / 2;
}
inline double measure(const corner_places<3>& p) {
  return signed_volume(*p[0], *p[1], *p[2], *p[3]);
}

/// The number of living ghosts, after checking: neighbours are mutual and share the side's vertices in
/// opposite directions, one ghost vertex per ghost, elements positive.
template <int D>
std::size_t check_structure(const triangulation<D>& t) {
  using mesh = triangulation<D>;
  std::size_t ghosts = 0, faults = 0;
  for (local_id e = 0; e < static_cast<local_id>(t.cells.size()); ++e) {
    if (!t.is_alive(e))
      continue;
    const auto& cell = t[e];
    const auto infinite = std::count(cell.vertices.begin(), cell.vertices.end(), mesh::infinite);
    faults += infinite > 1;
    ghosts += infinite == 1;
    faults += infinite == 0 && !(orientation<D>(t.points_of(e)) > 0);
    for (local_id i = 0; i <= D; ++i) {
      const local_id other = t.across(mesh::side_of(e, i));
      const local_id n = mesh::element_of(other);
      faults += !t.is_alive(n) || n == e || t.across(other) != mesh::side_of(e, i);
      // The neighbour with its own corner in place of this one's: the same vertices, in the other
      // orientation.
      auto mine = cell.vertices, theirs = t[n].vertices;
      mine[i] = -5;
      theirs[mesh::place_of(other)] = -5;
      int exchanges = 0;
      for (std::size_t k = 0; k < mine.size(); ++k) {
        const auto found = std::find(theirs.begin() + static_cast<std::ptrdiff_t>(k), theirs.end(), mine[k]);
        if (found == theirs.end()) {
          ++faults;
          break;
        }
        const auto place = static_cast<std::size_t>(found - theirs.begin());
        exchanges += place != k;
        std::swap(theirs[k], theirs[place]);
      }
      faults += exchanges % 2 == 0;
    }
  }
  CHECK(faults == 0);
  return ghosts;
}

/// No sphere holds the vertex across a side (which says the same of all vertices), and the hull is convex.
template <int D>
void check_locally_delaunay(const triangulation<D>& t) {
  using mesh = triangulation<D>;
  std::size_t faults = 0;
  for (local_id e = 0; e < static_cast<local_id>(t.cells.size()); ++e) {
    if (!t.is_alive(e))
      continue;
    for (local_id i = 0; i <= D; ++i) {
      const local_id other = t.across(mesh::side_of(e, i));
      const local_id n = mesh::element_of(other);
      const local_id apex = t[n].vertices[mesh::place_of(other)];
      if (apex == mesh::infinite)
        continue;
      if (!t.is_ghost(e)) {
        faults += sphere_side<D>(t.points_of(e), t.point(apex)) > 0;
      } else {
        corner_places<D> corners;
        for (std::size_t k = 0; k < corners.size(); ++k)
          corners[k] = &t.point(t[e].vertices[k] < 0 ? apex : t[e].vertices[k]);
        faults += orientation<D>(corners) > 0;
      }
    }
  }
  CHECK(faults == 0);
}

/// The sum of the elements' areas or volumes.
template <int D>
double total_measure(const triangulation<D>& t) {
  double sum = 0;
  for (local_id e = 0; e < static_cast<local_id>(t.cells.size()); ++e)
    if (t.is_alive(e) && !t.is_ghost(e))
      sum += measure(t.points_of(e));
  return sum;
}

/// Every point is a vertex, but those that lie where another one of a lower number does.
template <int D>
void check_vertices(const point_triangulation_result<D>& made) {
  const auto& t = made.triangulation;
  std::vector<char> used(t.points.size(), 0);
  for (local_id e = 0; e < static_cast<local_id>(t.cells.size()); ++e)
    if (t.is_alive(e))
      for (const local_id v : t[e].vertices)
        if (v >= 0)
          used[v] = 1;
  std::size_t faults = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    const std::size_t same = made.same_as[v];
    faults += same > v || !(t.points[same] == t.points[v]) || used[v] != (same == v);
  }
  CHECK(faults == 0);
}

/// Triangulates and checks all of the above.
template <int D>
point_triangulation_result<D> triangulate_and_check(const std::vector<point_of<D>>& points) {
  auto made = triangulate_points<D>(points);
  CHECK(check_structure(made.triangulation) >= D + 1);
  check_locally_delaunay(made.triangulation);
  check_vertices(made);
  return made;
}

} // namespace dovetail_test
