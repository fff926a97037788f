/// @file
/// Delaunay triangulations of points of the plane and of space.
#pragma once

#include "dovetail/triangulation/cavity.hpp"
#include "dovetail/triangulation/first_simplex.hpp"
#include "dovetail/triangulation/insertion_order.hpp"
#include "dovetail/triangulation/location.hpp"
#include "dovetail/triangulation/triangulation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// A triangulation of given points, and which of them are the same.
template <int D>
struct point_triangulation_result {
  dovetail::triangulation<D> triangulation; ///< vertices are the given points
  std::vector<local_id>
      same_as; ///< per given point: that of lowest number at the same place, which is the vertex
};

/// The elements between points, and their neighbours.
template <int D>
struct delaunay_elements {
  std::vector<simplex<D>> elements; ///< positively oriented; numbers of the given points
  /// Per element and side (opposite the vertex of the same place): the neighbour, `no_id` at the hull.
  std::vector<std::array<local_id, static_cast<std::size_t>(D) + 1>> neighbours;
  std::vector<local_id> same_as; ///< per given point: that of lowest number at the same place
};

namespace detail {

/// Elements that n points are expected to have, ghosts included.
template <int D>
constexpr std::size_t expected_elements(std::size_t n) {
  return D == 2 ? 2 * n + 16 : 7 * n + 64;
}

/// Gives the vertices, which are numbered in the order of insertion, their names.
template <int D>
void rename_vertices(triangulation<D>& t, const std::vector<local_id>& names) {
  for (auto& cell : t.cells)
    for (local_id& v : cell.vertices)
      if (v >= 0)
        v = names[v];
}

} // namespace detail

/// The Delaunay triangulation of points, with ghosts. Points are inserted in a biased random order; all
/// decisions are exact, and the result depends on nothing but the points. Of points on one sphere any
/// triangulation is Delaunay: which one it is, is left open.
///
/// O(n log n) expected for points that are not evil, 32 bytes per element. Throws `geometry_error` when a
/// coordinate is not finite, or all points are on one line (D = 2) or in one plane (D = 3).
/// \param points two (D = 2) or three coordinates each
template <int D>
point_triangulation_result<D> triangulate_points(std::span<const point_of<D>> points) {
  detail::require_finite<D>(points);
  const auto box = detail::box_of<D>(points);
  std::vector<local_id> order = detail::insertion_order<D>(points, box);
  detail::spanning_points_first<D>(points, order);

  std::array<double, static_cast<std::size_t>(D)> extent{};
  for (std::size_t k = 0; k < extent.size(); ++k)
    extent[k] = box[1][k] - box[0][k];
  const detail::box_predicates<D> predicates(extent);
  // While it grows, vertices are numbered in the order of insertion: what is close in space is so in memory.
  triangulation<D> t;
  t.points.reserve(points.size());
  for (const local_id i : order)
    t.points.push_back(points[i]);
  t.cells.reserve(detail::expected_elements<D>(points.size()));
  detail::begin_with_simplex(t, predicates);
  std::vector<local_id> names = order;
  std::vector<std::pair<local_id, local_id>> doubles; // a vertex and the one that was there before
  detail::cavity<D> cavity;
  local_id last = 0;
  for (auto v = local_id{D} + 1; v < static_cast<local_id>(order.size()); ++v) {
    const auto& p = t.point(v);
    const local_id e = detail::locate(t, predicates, p, last);
    const auto& corners = t[e].vertices;
    const auto* const same =
        std::find_if(corners.begin(), corners.end(), [&](local_id w) { return w >= 0 && t.point(w) == p; });
    if (same == corners.end()) {
      last = cavity.insert(t, predicates, v, e);
    } else {
      doubles.push_back({v, *same});
      names[*same] = std::min(names[*same], order[v]);
    }
  }
  for (const auto& [v, same] : doubles)
    names[v] = names[same];
  detail::rename_vertices(t, names);

  point_triangulation_result<D> result{std::move(t), std::vector<local_id>(points.size())};
  result.triangulation.points.assign(points.begin(), points.end());
  for (std::size_t k = 0; k < order.size(); ++k)
    result.same_as[order[k]] = names[k];
  return result;
}

/// The elements of a triangulation without its ghosts, and with dead ones left out. Linear.
template <int D>
delaunay_elements<D> elements_of(const triangulation<D>& t) {
  delaunay_elements<D> result;
  std::vector<local_id> numbers(t.cells.size(), no_id);
  local_id count = 0;
  for (local_id e = 0; e < static_cast<local_id>(t.cells.size()); ++e)
    if (t.is_alive(e) && !t.is_ghost(e))
      numbers[e] = count++;
  result.elements.reserve(count);
  result.neighbours.reserve(count);
  for (std::size_t e = 0; e < t.cells.size(); ++e)
    if (numbers[e] != no_id) {
      result.elements.push_back(t.cells[e].vertices);
      auto& neighbours = result.neighbours.emplace_back();
      for (std::size_t i = 0; i < neighbours.size(); ++i)
        neighbours[i] = numbers[triangulation<D>::element_of(t.cells[e].across[i])];
    }
  return result;
}

/// The Delaunay triangulation of points: `triangulate_points` without the ghosts. Cost and errors are those.
/// O(n log n) expected. Throws `geometry_error` when a coordinate is not finite, or all points are on one
/// line (D = 2) or in one plane (D = 3).
/// \param points two (D = 2) or three coordinates each
template <int D>
delaunay_elements<D> delaunay(std::span<const point_of<D>> points) {
  auto made = triangulate_points<D>(points);
  auto result = elements_of(made.triangulation);
  result.same_as = std::move(made.same_as);
  return result;
}

} // namespace dovetail
