/// @file
/// One archetype per concept of graphs and of what contracts them.
#pragma once

#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/simplification/concepts.hpp"
#include "dovetail/simplification/dual_graphs.hpp"

#include <array>
#include <optional>
#include <vector>

namespace dovetail::archetype {

// for graph
/// A path of nodes. Neither copyable nor movable: a graph is passed by reference.
struct path {
  explicit path(short count) : nodes(count) {}
  path(const path&) = delete;
  path& operator=(const path&) = delete;

  short node_count() const { return nodes; }
  template <class Visit>
  void for_each_neighbour(local_id v, const Visit& visit) const {
    if (v > 0)
      visit(v - 1);
    if (v + 1 < nodes)
      visit(v + 1);
  }

  short nodes;
};
// end

// for weighted_graph
/// A path whose edges weigh 2, its nodes 1.
struct weighted_path : path {
  using path::path;
  short node_weight(local_id) const { return 1; }
  template <class Visit>
  void for_each_edge(local_id v, const Visit& visit) const {
    for_each_neighbour(v, [&](local_id w) { visit(w, 2.0f); });
  }
};
// end

// for element_dual_graph
/// Elements in a row, with a side between each two and one at either end.
struct row_of_elements {
  explicit row_of_elements(short count) : elements_(count) {}
  row_of_elements(const row_of_elements&) = delete;
  row_of_elements& operator=(const row_of_elements&) = delete;

  short element_count() const { return elements_; }
  int side_count() const { return elements_ + 1; }
  float weight(local_id) const { return 1; }
  std::array<local_id, 2> elements(local_id side) const {
    return is_fixed(side) ? std::array<local_id, 2>{side == 0 ? 0 : side - 1, no_id}
                          : std::array<local_id, 2>{side - 1, side};
  }
  int is_fixed(local_id side) const { return side == 0 || side == elements_ ? 1 : 0; }
  short side_weight(local_id) const { return 3; }

private:
  short elements_;
};
// end

// for side_dual_graph
/// The sides of that row, all through one point: element k is the dihedral of 10 degrees between the sides k
/// and k + 1.
struct fan_of_sides {
  explicit fan_of_sides(short dihedrals) : dihedrals_(dihedrals) {}
  fan_of_sides(const fan_of_sides&) = delete;
  fan_of_sides& operator=(const fan_of_sides&) = delete;

  int side_count() const { return dihedrals_ + 1; }
  std::vector<double> angles() const {
    return std::vector<double>(static_cast<std::size_t>(dihedrals_), 10.0);
  }
  std::array<local_id, 2> sides(dihedral_id w) const {
    return {static_cast<local_id>(w), static_cast<local_id>(w) + 1};
  }
  template <class Visit>
  void for_each_joint(local_id side, const Visit& visit) const {
    visit(static_cast<dihedral_id>(side - 1), static_cast<dihedral_id>(side));
  }

private:
  short dihedrals_;
};
// end

// for contraction_rule, simplification_rule
/// The side of the larger number goes; a refused one costs 5. Not copyable: the contraction takes it by
/// reference.
struct contraction_rule {
  contraction_rule() = default;
  contraction_rule(const contraction_rule&) = delete;
  contraction_rule& operator=(const contraction_rule&) = delete;

  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return a.side > b.side; }
  float penalty(const deficit&) const { return 5; }
};
// end

// for simplification_rule
/// Dihedrals under 20 degrees are too small. Copyable, and neither default constructible nor assignable.
class simplification_rule {
public:
  explicit simplification_rule(int) {}
  simplification_rule(const simplification_rule&) = default;
  simplification_rule& operator=(const simplification_rule&) = delete;

  template <int D>
  side_judgement operator()(const simplicial_mesh<D>&, const side_table<D>& sides) const {
    return {std::vector<double>(sides.size(), 1.0), 0, 20};
  }
  std::optional<ridge_decision> propagate(const side_below&) const { return ridge_decision{{1, 2}}; }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return a.side > b.side; }
  float penalty(const deficit&) const { return 5; }
};
// end

} // namespace dovetail::archetype
