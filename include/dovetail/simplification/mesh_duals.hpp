/// @file
/// The dual graphs of a mesh as views: nothing is stored beyond the adjacency. Wedges are numbered
/// element x wedges per element + local ridge.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/concepts.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/simplification/dual_graphs.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dovetail {

/// The element-dual graph. What it is given must outlive it, unchanged.
template <int D>
class element_dual {
public:
  /// `weights`: one per element, or empty for 1 each. `fixed`: not zero for sides that are fixed although two
  /// elements meet there; may be empty.
  explicit element_dual(const side_table<D>& sides, std::span<const double> weights = {},
                        std::span<const std::uint8_t> fixed = {})
      : sides_(&sides), weights_(weights), fixed_(fixed), is_manifold_(sides.further_elements.empty()) {}
  explicit element_dual(const side_table<D>&&, std::span<const double> = {},
                        std::span<const std::uint8_t> = {}) = delete; // they would be gone

  std::size_t element_count() const { return sides_->of_element.size(); }
  std::size_t side_count() const { return sides_->size(); }
  double weight(local_id element) const {
    return weights_.empty() ? 1.0 : weights_[static_cast<std::size_t>(element)];
  }
  std::array<local_id, 2> elements(local_id side) const {
    const auto& pair = sides_->elements[static_cast<std::size_t>(side)]; // {element, no_id} on the boundary
    return is_manifold_ || !sides_->is_non_manifold(side) ? pair : std::array<local_id, 2>{pair[0], no_id};
  }
  bool is_fixed(local_id side) const {
    return (!fixed_.empty() && fixed_[static_cast<std::size_t>(side)] != 0) || elements(side)[1] == no_id;
  }

  // The edges that are not fixed, as a `graph`.
  std::size_t node_count() const { return element_count(); }
  template <class Visit>
  void for_each_neighbour(local_id element, const Visit& visit) const {
    for (const local_id side : sides_->of_element[static_cast<std::size_t>(element)])
      if (!is_fixed(side)) {
        const auto [a, b] = elements(side);
        visit(a == element ? b : a);
      }
  }

private:
  const side_table<D>* sides_;
  std::span<const double> weights_;
  std::span<const std::uint8_t> fixed_;
  bool is_manifold_;
};
static_assert(element_dual_graph<element_dual<2>> && element_dual_graph<element_dual<3>>);
static_assert(graph<element_dual<2>> && graph<element_dual<3>>);

/// The side-dual graph. The mesh and its table must outlive it, unchanged.
template <int D>
class side_dual {
public:
  static constexpr std::size_t wedges_per_element = numbering::ridges<D>.size();

  /// Throws `mesh_error` when `require_valid` refuses the mesh, unless it is known to be valid.
  side_dual(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
            mesh_state mesh_is = mesh_state::unknown)
      : mesh_(&mesh), sides_(&sides) {
    detail::require_valid_unless(mesh_is, mesh, sides, "side_dual");
  }

  std::size_t side_count() const { return sides_->size(); }
  std::vector<double> angles() const {
    std::vector<double> all;
    all.reserve(mesh_->elements.size() * wedges_per_element);
    for (const auto& element : mesh_->elements) {
      const auto angles = wedge_angles(corners(span_of(mesh_->points), element));
      all.insert(all.end(), angles.begin(), angles.end());
    }
    return all;
  }
  std::array<local_id, 2> sides(wedge_id wedge) const {
    const auto& of_element = sides_->of_element[wedge / wedges_per_element];
    const auto& local = numbering::sides_of_ridge<D>[wedge % wedges_per_element];
    return {of_element[static_cast<std::size_t>(local[0])], of_element[static_cast<std::size_t>(local[1])]};
  }
  template <class Visit>
  void for_each_joint(local_id side, const Visit& visit) const {
    const auto [a, b] = sides_->elements[static_cast<std::size_t>(side)];
    const auto& of_a = sides_->of_element[static_cast<std::size_t>(a)];
    const auto local = static_cast<int>(std::find(of_a.begin(), of_a.end(), side) - of_a.begin());
    for (std::size_t r = 0; r < wedges_per_element; ++r) {
      const auto& ends = numbering::sides_of_ridge<D>[r];
      if (ends[0] == local || ends[1] == local)
        visit(number_of(a, r), number_of(b, same_ridge(a, r, b)));
    }
  }

private:
  static wedge_id number_of(local_id element, std::size_t ridge) {
    return static_cast<wedge_id>(static_cast<std::size_t>(element) * wedges_per_element + ridge);
  }
  /// The local ridge of element `to` with the vertices of local ridge r of element `from`.
  std::size_t same_ridge(local_id from, std::size_t r, local_id to) const {
    const auto& here = mesh_->elements[static_cast<std::size_t>(from)];
    const auto& there = mesh_->elements[static_cast<std::size_t>(to)];
    const auto key = sorted_vertices(detail::pick(here, numbering::ridges<D>[r]));
    std::size_t match = 0;
    while (sorted_vertices(detail::pick(there, numbering::ridges<D>[match])) != key)
      ++match;
    return match;
  }

  const simplicial_mesh<D>* mesh_;
  const side_table<D>* sides_;
};
static_assert(side_dual_graph<side_dual<2>> && side_dual_graph<side_dual<3>>);

} // namespace dovetail
