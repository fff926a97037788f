/// @file
/// What `mesh_exchange.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/point_numbering.hpp"
#include "dovetail/improver/tetrahedra/curve_order.hpp"
#include "dovetail/improver/tetrahedra/mesh_exchange.hpp"
#include "dovetail/improver/tetrahedra/tet_complex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::improvement::detail {

[[noreturn]] inline void refuse_frozen_side(simplex<2> side) {
  sort_all(side);
  throw mesh_error("frozen side (" + std::to_string(side[0]) + ", " + std::to_string(side[1]) + ", " +
                   std::to_string(side[2]) + ") is not a side of the mesh");
}

/// Fixes the sides that have nothing behind them or another tag.
inline void fix_outer_sides(tet_complex& mesh) {
  for (local_id e = 0; e < mesh.element_slots(); ++e)
    for (int side = 0; side < 4; ++side)
      if (mesh.across(e, side) == no_id)
        mesh.fix_side(e, side);
  for (local_id e = 0; mesh.has_tags() && e < mesh.element_slots(); ++e)
    for (int side = 0; side < 4; ++side)
      if (const half_side other = mesh.across(e, side);
          other != no_id && mesh.tag(element_of(other)) != mesh.tag(e))
        mesh.fix_side(e, side);
}

/// The frozen sides by the complex's own names, to be looked up.
class frozen_sides {
public:
  /// Throws `mesh_error` when a side has a vertex that does not exist.
  frozen_sides(const tet_complex& mesh, const frozen_entities<3>& frozen)
      : first_of_(static_cast<std::size_t>(mesh.vertex_slots()) + 1, 0),
        has_vertex_(static_cast<std::size_t>(mesh.vertex_slots()), 0) {
    std::vector<local_id> names(static_cast<std::size_t>(mesh.given_vertices()));
    for (local_id v = 0; v < mesh.given_vertices(); ++v)
      names[mesh.given_number(v)] = v;
    for (simplex<2> side : frozen.sides) {
      for (const local_id number : side)
        if (number < 0 || number >= mesh.given_vertices())
          refuse_frozen_side(side);
      for (auto& v : side)
        v = names[v];
      sort_all(side);
      keys_.push_back(side);
    }
    sort_unique(keys_);
    for (const auto& key : keys_) {
      ++first_of_[key[0] + 1];
      for (const local_id v : key)
        has_vertex_[v] = 1;
    }
    std::partial_sum(first_of_.begin(), first_of_.end(), first_of_.begin());
  }

  /// Each with its corners in ascending order.
  const std::vector<std::array<local_id, 3>>& keys() const { return keys_; }
  /// Whether one of them may be a side of an element with these vertices.
  bool may_have_one(const simplex<3>& v) const {
    return has_vertex_[v[0]] + has_vertex_[v[1]] + has_vertex_[v[2]] + has_vertex_[v[3]] > 2;
  }
  /// The number of one among the keys, or how many these are.
  std::size_t find(const std::array<local_id, 3>& key) const {
    for (std::size_t k = first_of_[key[0]]; k < first_of_[key[0] + 1]; ++k)
      if (keys_[k] == key)
        return k;
    return keys_.size();
  }

private:
  std::vector<std::array<local_id, 3>> keys_;
  std::vector<std::uint32_t> first_of_;  ///< per vertex: of the keys whose lowest vertex it is
  std::vector<std::uint8_t> has_vertex_; ///< whether some key has a vertex
};

/// Fixes the sides that the caller froze. Throws `mesh_error` when one is not there.
inline void fix_frozen_sides(tet_complex& mesh, const frozen_entities<3>& frozen) {
  const frozen_sides sides(mesh, frozen);
  const auto& keys = sides.keys();
  std::vector<bool> found(keys.size(), false);
  for (local_id e = 0; e < mesh.element_slots(); ++e)
    for (int side = sides.may_have_one(mesh.vertices(e)) ? 0 : 4; side < 4; ++side)
      if (const std::size_t k = sides.find(sorted_side(mesh.vertices(e), side)); k < keys.size()) {
        found[k] = true;
        mesh.fix_side(e, side);
      }
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (!found[k])
      refuse_frozen_side(
          {mesh.given_number(keys[k][0]), mesh.given_number(keys[k][1]), mesh.given_number(keys[k][2])});
}

/// Fixes the vertices of fixed sides, and the caller's frozen points.
inline void fix_vertices(tet_complex& mesh, const frozen_entities<3>& frozen) {
  for (local_id e = 0; e < mesh.element_slots(); ++e)
    if (mesh.has_fixed_side(e))
      for (int side = 0; side < 4; ++side)
        if (mesh.is_fixed(e, side))
          for (const int corner : numbering::sides<3>[side])
            mesh.set_kind(mesh.vertex(e, corner), vertex_kind::fixed);
  for (local_id v = 0; frozen.points > 0 && v < mesh.given_vertices(); ++v)
    if (mesh.given_number(v) < frozen.points && mesh.kind(v) != vertex_kind::unused)
      mesh.set_kind(v, vertex_kind::fixed);
  mesh.finish_kinds();
}

} // namespace dovetail::improvement::detail

namespace dovetail::improvement {

DOVETAIL_INLINE tet_complex take_mesh(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen,
                                      layout order) {
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    throw mesh_error("the mesh has " + std::to_string(mesh.elements.size()) + " elements but " +
                     std::to_string(mesh.tags.size()) + " tags");
  check_vertices(span_of(mesh.elements), mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (!std::isfinite(norm_squared(mesh.points[v])))
      throw mesh_error("point " + std::to_string(v) + " has a coordinate that is not finite or too large");
  std::vector<local_id> numbers;
  if (order == layout::along_curve)
    numbers = order_along_curve(mesh);
  tet_complex complex(std::move(mesh.points), std::move(mesh.elements), std::move(mesh.tags),
                      std::move(numbers));
  detail::fix_outer_sides(complex);
  if (!frozen.sides.empty())
    detail::fix_frozen_sides(complex, frozen);
  detail::fix_vertices(complex, frozen);
  return complex;
}

} // namespace dovetail::improvement

namespace dovetail::improvement::detail {

/// Moves the living elements, with their tags, to the front.
inline void drop_dead_elements(tet_complex& complex) {
  auto& elements = complex.elements();
  auto& tags = complex.tags();
  std::size_t kept = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (elements[e][0] == no_id)
      continue;
    elements[kept] = elements[e];
    if (!tags.empty())
      tags[kept] = tags[e];
    ++kept;
  }
  elements.resize(kept);
  if (!tags.empty())
    tags.resize(kept);
}

/// The number that each vertex is given back with; that of a removed one is not to be used.
inline std::vector<local_id> final_numbers(const tet_complex& complex, std::size_t& points) {
  std::vector<bool> keeps_number(static_cast<std::size_t>(complex.given_vertices()), false);
  std::size_t free = 0;
  for (local_id v = 0; v < complex.vertex_slots(); ++v) {
    if (complex.is_free(v))
      ++free;
    else if (!complex.is_gap(v))
      keeps_number[complex.given_number(v)] = true;
  }
  const point_numbering numbering(keeps_number, free);
  points = numbering.size;
  std::vector<local_id> numbers(static_cast<std::size_t>(complex.vertex_slots()), no_id);
  auto next = numbering.of_free.begin();
  for (local_id v = 0; v < complex.vertex_slots(); ++v)
    if (!complex.is_gap(v))
      numbers[v] = complex.is_free(v) ? *next++ : complex.given_number(v);
  return numbers;
}

} // namespace dovetail::improvement::detail

namespace dovetail::improvement {

DOVETAIL_INLINE void give_back(tet_complex& complex, simplicial_mesh<3>& mesh) {
  detail::drop_dead_elements(complex);
  std::size_t points = 0;
  const auto numbers = detail::final_numbers(complex, points);
  mesh.points.assign(points, vec3{});
  for (local_id v = 0; v < complex.vertex_slots(); ++v)
    if (const local_id number = numbers[v]; number != no_id)
      mesh.points[number] = complex.point(v);
  mesh.elements = std::move(complex.elements());
  for (auto& element : mesh.elements)
    for (auto& v : element)
      v = numbers[v];
  mesh.tags = std::move(complex.tags());
}

} // namespace dovetail::improvement
