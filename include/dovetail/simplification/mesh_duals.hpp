/// @file
/// The dual graphs of a mesh as views: nothing is stored beyond the adjacency. Dihedrals are numbered
/// element x dihedrals per element + local ridge.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/concepts.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/simplification/dual_graphs.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
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
  double weight(local_id element) const { return weights_.empty() ? 1.0 : weights_[element]; }
  std::array<local_id, 2> elements(local_id side) const {
    const auto& pair = sides_->elements[side]; // {element, no_id} on the boundary
    return is_manifold_ || !sides_->is_non_manifold(side) ? pair : std::array<local_id, 2>{pair[0], no_id};
  }
  bool is_fixed(local_id side) const {
    return (!fixed_.empty() && fixed_[side] != 0) || elements(side)[1] == no_id;
  }

  double side_weight(local_id) const { return 1; }

  // The edges that are not fixed, as a `weighted_graph`.
  std::size_t node_count() const { return element_count(); }
  double node_weight(local_id element) const { return weight(element); }
  template <class Visit>
  void for_each_edge(local_id element, const Visit& visit) const {
    for_each_neighbour(element, [&](local_id other) { visit(other, 1.0); });
  }
  template <class Visit>
  void for_each_neighbour(local_id element, const Visit& visit) const {
    for (const local_id side : sides_->of_element[element])
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
static_assert(weighted_graph<element_dual<2>> && weighted_graph<element_dual<3>>);

/// The side-dual graph. The mesh and its table must outlive it, unchanged.
template <int D>
class side_dual {
public:
  static constexpr std::size_t dihedrals_per_element = numbering::ridges<D>.size(); ///< ridges of an element

  /// Throws `mesh_error` when `require_valid` refuses the mesh, unless it is known to be valid.
  side_dual(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
            mesh_state mesh_is = mesh_state::unknown)
      : mesh_(&mesh), sides_(&sides) {
    detail::require_valid_unless(mesh_is, mesh, sides, "side_dual");
  }

  std::size_t side_count() const { return sides_->size(); }
  std::vector<double> angles() const {
    std::vector<double> all;
    all.reserve(mesh_->elements.size() * dihedrals_per_element);
    for (const auto& element : mesh_->elements) {
      const auto angles = dihedral_angles(corners(span_of(mesh_->points), element));
      all.insert(all.end(), angles.begin(), angles.end());
    }
    return all;
  }
  std::array<local_id, 2> sides(dihedral_id dihedral) const {
    const auto& of_element = sides_->of_element[dihedral / dihedrals_per_element];
    const auto& local = numbering::sides_of_ridge<D>[dihedral % dihedrals_per_element];
    return {of_element[local[0]], of_element[local[1]]};
  }
  template <class Visit>
  void for_each_joint(local_id side, const Visit& visit) const {
    const auto [a, b] = sides_->elements[side];
    const auto& of_a = sides_->of_element[a];
    const auto local = static_cast<int>(std::find(of_a.begin(), of_a.end(), side) - of_a.begin());
    for (std::size_t r = 0; r < dihedrals_per_element; ++r) {
      const auto& ends = numbering::sides_of_ridge<D>[r];
      if (ends[0] == local || ends[1] == local)
        visit(number_of(a, r), number_of(b, same_ridge(a, r, b)));
    }
  }

private:
  static dihedral_id number_of(local_id element, std::size_t ridge) {
    return static_cast<dihedral_id>(static_cast<std::size_t>(element) * dihedrals_per_element + ridge);
  }
  /// The local ridge of element `to` with the vertices of local ridge r of element `from`.
  std::size_t same_ridge(local_id from, std::size_t r, local_id to) const {
    const auto& here = mesh_->elements[from];
    const auto& there = mesh_->elements[to];
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

namespace detail {

/// Not zero for the given sides, and for those between elements of different tags.
template <int D>
std::vector<std::uint8_t> fixed_inside(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                                       std::span<const simplex<D - 1>> fixed_sides) {
  std::vector<simplex<D - 1>> given;
  given.reserve(fixed_sides.size());
  for (const auto& vertices : fixed_sides)
    given.push_back(sorted_vertices(vertices));
  sort_all(given);
  const auto changes_tag = [&](std::size_t side) {
    const auto [a, b] = sides.elements[side];
    return !mesh.tags.empty() && b != no_id && mesh.tags[a] != mesh.tags[b];
  };
  std::vector<std::uint8_t> fixed(sides.size(), 0);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const bool listed =
        !given.empty() && std::binary_search(given.begin(), given.end(), sorted_vertices(sides.vertices[s]));
    fixed[s] = listed || changes_tag(s) ? 1 : 0;
  }
  return fixed;
}

} // namespace detail

/// What is known of a mesh beside it; each may be empty.
template <int D>
struct mesh_dual_options {
  std::span<const simplex<D - 1>> fixed_sides = {}; ///< in any order of vertices; read at once
  std::span<const double> element_weights = {};     ///< predicted final elements; empty: 1 each
  mesh_state mesh_is = mesh_state::unknown;         ///< `valid`: `require_valid` has seen it
};

/// Both dual graphs of a mesh, and its sides. Fixed are the boundary, sides between elements of different
/// tags and the sides given. The mesh and the weights must outlive it, unchanged, and so must the table of
/// sides unless it was moved in or left out.
template <int D>
class mesh_duals {
public:
  mesh_duals(const simplicial_mesh<D>& mesh, const mesh_dual_options<D>& given = {})
      : mesh_duals(mesh, build_sides(mesh), given) {}
  /// `sides`: `build_sides(mesh)`. Throws `mesh_error` when `require_valid` refuses the mesh, which takes
  /// about a tenth of the time of its simplification, and `usage_error` for a wrong number of weights.
  mesh_duals(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
             const mesh_dual_options<D>& given = {})
      : mesh_duals(mesh, std::shared_ptr<const side_table<D>>(std::shared_ptr<void>(), &sides), given) {}
  mesh_duals(const simplicial_mesh<D>& mesh, side_table<D>&& sides, const mesh_dual_options<D>& given = {})
      : mesh_duals(mesh, std::make_shared<const side_table<D>>(std::move(sides)), given) {}

  const simplicial_mesh<D>& mesh() const { return *mesh_; } ///< the mesh, and its sides (`sides`)
  const side_table<D>& sides() const { return *sides_; }
  /// The element-dual graph.
  element_dual<D> elements() const { return element_dual<D>(*sides_, weights_, span_of(fixed_)); }
  side_dual<D> dihedrals() const { return {*mesh_, *sides_, mesh_state::valid}; } ///< the side-dual graph

private:
  mesh_duals(const simplicial_mesh<D>& mesh, std::shared_ptr<const side_table<D>> sides,
             const mesh_dual_options<D>& given)
      : mesh_(&mesh), sides_(std::move(sides)), weights_(given.element_weights),
        fixed_(fixed_sides_of(mesh, *sides_, given)) {
    if (!weights_.empty() && weights_.size() != mesh.elements.size())
      throw usage_error("mesh_duals: " + std::to_string(weights_.size()) + " element weights for " +
                        std::to_string(mesh.elements.size()) + " elements; give one each or none");
  }

  static std::vector<std::uint8_t> fixed_sides_of(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                                                  const mesh_dual_options<D>& given) {
    detail::require_valid_unless(given.mesh_is, mesh, sides, "mesh_duals");
    return detail::fixed_inside<D>(mesh, sides, given.fixed_sides);
  }

  const simplicial_mesh<D>* mesh_;
  std::shared_ptr<const side_table<D>> sides_;
  std::span<const double> weights_;
  std::vector<std::uint8_t> fixed_; ///< per side
};

} // namespace dovetail
