/// @file
/// What `checks.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/chain_sum.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/boundary_sides.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/result_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE double enclosed_volume(std::span<const vec3> points, std::span<const simplex<2>> triangles) {
  box3 box;
  for (const auto& triangle : triangles)
    for (const local_id v : triangle)
      box.include(points[v]);
  const vec3 origin = box.center();
  double volume = 0;
  for (const auto& t : triangles)
    volume -= signed_volume(points[t[0]], points[t[1]], points[t[2]], origin);
  return volume;
}

namespace detail {

/// Every listed triangle is a side of exactly one element, on the side it is listed for, and of no other;
/// the elements fit together. With positive elements the second says the first, but for triangles listed in
/// both directions, so that single ones are looked at where there is something to find.
inline void check_boundary_kept(const simplicial_mesh<2>& boundary, const simplicial_mesh<3>& mesh) {
  const boundary_sides sides(span_of(boundary.elements));
  const bool fit = fit_together<3>(boundary, mesh);
  if (fit && sides.entries().size() == boundary.elements.size())
    return;
  std::vector<std::array<int, 2>> uses(sides.entries().size(), {0, 0});
  for (const auto& element : mesh.elements)
    for (const auto& local : numbering::sides<3>)
      if (const auto found = sides.find(detail::pick(element, local)))
        ++uses[found.entry][found.parity];
  std::size_t lost = 0;
  for (std::size_t k = 0; k < uses.size(); ++k)
    for (std::size_t p = 0; p < 2; ++p) {
      const bool listed = sides.entries()[k].listed[p] != no_id;
      if (uses[k][p] > (listed ? 1 : 0))
        throw mesher_error(
            "the elements overlap each other or the outside at boundary triangle " +
            std::to_string(std::max(sides.entries()[k].listed[0], sides.entries()[k].listed[1])));
      lost += listed && uses[k][p] == 0;
    }
  if (lost > 0)
    throw mesher_error(std::to_string(lost) + " of " + std::to_string(boundary.elements.size()) +
                       " boundary triangles are lost");
  if (!fit)
    throw_no_fit();
}

inline void throw_not_positive(std::size_t element) {
  throw mesher_error("element " + std::to_string(element) + " is flat or inverted");
}

/// All elements are positive and together as large as what the boundary encloses.
inline void check_volumes(const simplicial_mesh<2>& boundary, const simplicial_mesh<3>& mesh) {
  const double expected = enclosed_volume(span_of(boundary.points), span_of(boundary.elements));
  box3 box;
  for (const vec3 p : boundary.points)
    box.include(p);
  double volume = 0;
  const auto at = [&](local_id v) { return mesh.points[v]; };
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& [a, b, c, d] = mesh.elements[e];
    if (!(orient3d(at(a), at(b), at(c), at(d)) > 0))
      throw_not_positive(e);
    volume += signed_volume(at(a), at(b), at(c), at(d));
  }
  // Rounding of coordinates: relative to the sum for the elements, to the box for thin bodies.
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * std::pow(box.diagonal(), 3);
  if (!(std::abs(volume - expected) <= 1e-9 * std::abs(expected) + rounding))
    throw mesher_error("the elements fill a volume of " + number_text(volume) + ", the boundary encloses " +
                       number_text(expected));
}

} // namespace detail

DOVETAIL_INLINE void check_elements_positive(const simplicial_mesh<3>& mesh) {
  const auto at = [&](local_id v) { return mesh.points[v]; };
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& [a, b, c, d] = mesh.elements[e];
    if (!(orient3d(at(a), at(b), at(c), at(d)) > 0))
      detail::throw_not_positive(e);
  }
}

DOVETAIL_INLINE void require_meshable(const simplicial_mesh<2>& boundary) {
  if (boundary.elements.empty())
    throw mesher_error("a boundary without triangles encloses nothing");
  for (std::size_t t = 0; t < boundary.elements.size(); ++t)
    for (const local_id v : boundary.elements[t])
      if (v < 0 || static_cast<std::size_t>(v) >= boundary.points.size())
        throw mesher_error("boundary triangle " + std::to_string(t) + " refers to point " +
                           std::to_string(v) + ", which does not exist");
  for (std::size_t v = 0; v < boundary.points.size(); ++v)
    if (!detail::is_finite(boundary.points[v]))
      throw mesher_error("boundary point " + std::to_string(v) + " is at " + place_text(boundary.points[v]) +
                         "; give finite coordinates");
}

namespace detail {

/// Names an edge that is not passed as often in one direction as in the other.
[[noreturn]] inline void throw_open_edge(const simplicial_mesh<2>& boundary) {
  std::map<simplex<1>, std::pair<std::int64_t, std::size_t>> passed; // balance, and the first triangle
  for (std::size_t t = 0; t < boundary.elements.size(); ++t)
    for (const auto& local : numbering::sides<2>) {
      const simplex<1> edge = pick(boundary.elements[t], local);
      auto& [balance, first] = passed.try_emplace(sorted_vertices(edge), 0, t).first->second;
      balance += edge[0] < edge[1] ? 1 : -1;
    }
  for (const auto& [edge, found] : passed)
    if (found.first != 0)
      throw mesher_error("at the edge (" + listed_points(edge) + ") of boundary triangle " +
                         std::to_string(found.second) +
                         " a triangle is missing, there twice or turned over; give closed shells, oriented "
                         "outwards");
  throw mesher_error("the boundary is not closed; give closed shells, oriented outwards");
}

} // namespace detail

DOVETAIL_INLINE void require_enclosing(const simplicial_mesh<2>& boundary) {
  require_meshable(boundary);
  chain_sum edges;
  for (std::size_t t = 0; t < boundary.elements.size(); ++t) {
    const auto& triangle = boundary.elements[t];
    const auto at = [&](std::size_t k) { return boundary.points[triangle[k]]; };
    if (detail::collinear(at(0), at(1), at(2)))
      throw mesher_error("boundary triangle " + std::to_string(t) + " (points " +
                         detail::listed_points(triangle) +
                         ") is flat: its area is 0; remove it or move a point of it");
    edges.add_sides_of(triangle);
  }
  if (!(edges == chain_sum{}))
    detail::throw_open_edge(boundary);
  if (const double volume = enclosed_volume(span_of(boundary.points), span_of(boundary.elements));
      !(volume > 0))
    throw mesher_error("the boundary encloses a volume of " + number_text(volume) +
                       "; orient its outer shells outwards");
}

DOVETAIL_INLINE void check_mesher_result(const mesher_input<3>& input, const simplicial_mesh<3>& mesh) {
  detail::check_entries(mesh);
  for (std::size_t e = 0; e < mesh.tags.size(); ++e)
    if (mesh.tags[e] != input.material)
      throw mesher_error("element " + std::to_string(e) + " has the tag " + std::to_string(mesh.tags[e]) +
                         ", the piece is of material " + std::to_string(input.material));
  detail::check_points_kept(input.boundary.points, mesh.points);
  detail::check_points_used(input.boundary.points.size(), mesh);
  detail::check_boundary_kept(input.boundary, mesh);
  detail::check_volumes(input.boundary, mesh);
}

} // namespace dovetail
