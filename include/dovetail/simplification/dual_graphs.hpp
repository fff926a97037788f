/// @file
/// What the simplification asks of the two dual graphs of Section 3.3 of the paper: the EDG, whose nodes are
/// contracted, and the SDG, whose nodes are deleted. `mesh_duals.hpp` has those of a mesh, `graph_dual.hpp`
/// makes both of any graph.
#pragma once

#include "dovetail/core/ids.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail {

/// A dihedral's number in its side-dual graph.
using dihedral_id = std::uint32_t;

/// An element-dual graph (EDG): nodes are elements with weights, edges are sides.
///
/// Valid expressions for `const G& g`, `local_id element`, `local_id side`:
///
/// - `g.element_count()`, `g.side_count()`: std::size_t; both are numbered 0, 1, 2, ...
/// - `g.weight(element)`: double, positive: what the element counts in a subdomain
/// - `g.elements(side)`: std::array<local_id, 2>, the two ends of the edge; the second is `no_id` where the
///   side does not lie between exactly two elements and so is no edge
/// - `g.is_fixed(side)`: bool: the side may never be removed
/// - `g.side_weight(side)`: double, positive: the cost of cutting the side; 1 in a mesh. A refused side
///   weighs that times its rule's penalty
///
/// Semantics: a side that is no edge is fixed. Two elements may share several sides.
///
/// Complexity: constant; all weights are read once.
///
/// Failure: none; a number out of range is undefined behaviour.
///
/// Models: element_dual, graph_dual.
template <class G>
concept element_dual_graph = requires(const G& g, local_id element, local_id side) {
  { g.element_count() } -> std::convertible_to<std::size_t>;
  { g.side_count() } -> std::convertible_to<std::size_t>;
  { g.weight(element) } -> std::convertible_to<double>;
  { g.elements(side) } -> std::convertible_to<std::array<local_id, 2>>;
  { g.is_fixed(side) } -> std::convertible_to<bool>;
  { g.side_weight(side) } -> std::convertible_to<double>;
};

/// A side-dual graph (SDG): nodes are sides, edges are dihedrals with angles.
///
/// Valid expressions for `const G& g`, `local_id side`, `dihedral_id dihedral`:
///
/// - `g.side_count()`: std::size_t, with the numbers of the element-dual graph
/// - `g.angles()`: std::vector<double>, the angle of every dihedral in degrees, in the order of their numbers
/// - `g.sides(dihedral)`: std::array<local_id, 2>, the two sides that bound it
/// - `g.for_each_joint(side, visit)`: calls `visit(v, w)` for every two dihedrals that the side parts
///
/// Semantics: v and w are dihedrals at the same ridge, one on each side of the side: removing it makes one
/// dihedral of them, whose angle is the sum. A dihedral has at most one such partner across each of its
/// sides. Joints of fixed sides are not asked for.
///
/// Complexity: constant, of a side's joints linear in their number; the angles are read once.
///
/// Failure: none; a number out of range is undefined behaviour.
///
/// Models: side_dual, graph_dual.
template <class G>
concept side_dual_graph = requires(const G& g, local_id side, dihedral_id dihedral,
                                   void (&visit)(dihedral_id, dihedral_id)) {
  { g.side_count() } -> std::convertible_to<std::size_t>;
  { g.angles() } -> std::convertible_to<std::vector<double>>;
  { g.sides(dihedral) } -> std::convertible_to<std::array<local_id, 2>>;
  g.for_each_joint(side, visit);
};

} // namespace dovetail
