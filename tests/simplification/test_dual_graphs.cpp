#include "dovetail/graph/contraction.hpp"
#include "dovetail/simplification/bounded_contraction.hpp"
#include "dovetail/simplification/graph_dual.hpp"
#include "dovetail/simplification/mesh_duals.hpp"
#include "dovetail/simplification/paper.hpp"
#include "simplification/squeezed_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

using namespace dovetail;
using namespace dovetail_test;

namespace {

/// Sectors around one point, without any mesh: element k lies between the spokes k and k + 1.
struct sectors {
  std::vector<double> angle; ///< of each sector; they need not add up to a turn
  std::vector<std::uint8_t> fixed_spoke;
  std::vector<double> spoke_weight = {}; ///< empty: 1 each

  std::size_t element_count() const { return angle.size(); }
  std::size_t side_count() const { return angle.size(); }
  double weight(local_id) const { return 1; }
  std::array<local_id, 2> elements(local_id spoke) const {
    const auto n = static_cast<local_id>(angle.size());
    return {(spoke + n - 1) % n, spoke};
  }
  bool is_fixed(local_id spoke) const { return fixed_spoke[spoke] != 0; }
  double side_weight(local_id spoke) const { return spoke_weight.empty() ? 1.0 : spoke_weight[spoke]; }
  const std::vector<double>& angles() const { return angle; }
  std::array<local_id, 2> sides(dihedral_id k) const {
    return {static_cast<local_id>(k), static_cast<local_id>((k + 1) % angle.size())};
  }
  template <class Visit>
  void for_each_joint(local_id spoke, const Visit& visit) const {
    const auto [before, behind] = elements(spoke);
    visit(static_cast<dihedral_id>(before), static_cast<dihedral_id>(behind));
  }
};
static_assert(element_dual_graph<sectors> && side_dual_graph<sectors>);

/// Of two spokes the one with the larger number goes; a refused one weighs seven times its weight.
struct last_goes {
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return a.side > b.side; }
  double penalty(const deficit&) const { return 7; }
};
/// The one that makes the lighter super-element goes.
struct light_goes : last_goes {
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const {
    return std::pair(a.weight, a.side) < std::pair(b.weight, b.side);
  }
};

constexpr contraction_bound no_bound{.fraction = 1, .always_allowed_elements = 100};

simplification contracted(const sectors& around, const side_judgement& judged,
                          const contraction_bound& bound = no_bound,
                          std::span<const coupled_side> coupled = {}) {
  return contract_bounded(around, around, judged, last_goes{}, bound, coupled);
}

constexpr auto kept = side_state::kept, removed = side_state::removed, refused = side_state::refused,
               fixed_side = side_state::fixed;
using states = std::vector<side_state>;
const std::vector<double> good(6, 1.0);

} // namespace

TEST_CASE("small dihedrals of a graph that is no mesh are joined until none is left") {
  const sectors around{{80, 20, 80, 80, 80, 20}, {1, 0, 0, 0, 0, 0}};
  // The dihedral 1 lies between the spokes 1 and 2, of which 2 goes; the dihedral 5 between 5 and the fixed
  // 0.
  const auto result = contracted(around, {good, 0, 50});
  CHECK(result.side_states == states{fixed_side, kept, removed, kept, kept, removed});
  CHECK(result.super_of_element == std::vector<local_id>{0, 1, 1, 2, 3, 3});
  CHECK(result.graph.node_weights == std::vector<double>{1, 2, 1, 2});
  CHECK(result.forced.empty());
}

TEST_CASE("a run that is still small grows on") {
  const sectors around{{10, 10, 10, 10, 100, 100}, {1, 0, 0, 0, 1, 0}};
  const auto result = contracted(around, {good, 0, 35});
  // 0 and 1 join first, then 2 and 3, then these two runs; the whole has 40 degrees.
  CHECK(result.side_states == states{fixed_side, removed, removed, removed, fixed_side, kept});
  CHECK(result.super_count == 3);
}

TEST_CASE("a small dihedral between fixed sides is forced") {
  const sectors around{{10, 80, 80, 80, 80, 30}, {1, 1, 0, 0, 0, 0}};
  const auto result = contracted(around, {good, 0, 20});
  REQUIRE(result.forced.size() == 1);
  CHECK(result.forced[0].sides == std::array<local_id, 2>{0, 1});
  CHECK(result.forced[0].angle_deg == 10);
}

TEST_CASE("what the bound refuses stays, at its penalty") {
  const sectors around{{60, 60, 60, 60, 60, 60}, {0, 0, 0, 0, 0, 0}};
  const contraction_bound two_elements{.fraction = 0, .always_allowed_elements = 2};
  const side_judgement judged{{9, 1, 2, 9, 9, 9}, 5, 0};
  const auto result = contracted(around, judged, two_elements);
  CHECK(result.side_states == states{kept, removed, refused, kept, kept, kept});
  REQUIRE(result.refused.size() == 1);
  CHECK(result.refused[0].missed.value == 2);
  CHECK(result.refused[0].missed.wanted == 5);
  CHECK(result.super_of_element == std::vector<local_id>{0, 0, 1, 2, 3, 4});
  const auto row = result.graph.row(0);
  REQUIRE((row.size() == 2 && row[0] == 1));
  CHECK(result.graph.edge_weights[0] == 7);
  CHECK(result.graph.edge_weights[1] == 1);
}

TEST_CASE("sides keep their weights, and the penalty of a refused one multiplies its own") {
  const sectors around{{60, 60, 60, 60, 60, 60}, {0, 0, 0, 0, 0, 0}, {2, 9, 3, 0.5, 4, 5}};
  const contraction_bound two_elements{.fraction = 0, .always_allowed_elements = 2};
  const auto result = contracted(around, {{9, 1, 2, 9, 9, 9}, 5, 0}, two_elements); // 1 goes, 2 is refused
  CHECK(result.graph.neighbours == std::vector<local_id>{1, 4, 0, 2, 1, 3, 2, 4, 0, 3});
  CHECK(result.graph.edge_weights == std::vector<double>{21, 2, 21, 0.5, 0.5, 4, 4, 5, 2, 5});
}

TEST_CASE("a plain graph has a side per edge, in the order of its nodes, and no dihedrals") {
  const std::vector<weighted_edge> edges{{2, 0, 5}, {0, 1, 3}, {1, 2, 4}, {3, 2, 1}};
  const graph_dual duals(make_csr_graph({1, 2, 3, 4}, edges));
  REQUIRE(duals.side_count() == 4);
  CHECK(duals.elements(0) == std::array<local_id, 2>{0, 1});
  CHECK(duals.elements(1) == std::array<local_id, 2>{0, 2});
  CHECK(duals.side_weight(1) == 5);
  CHECK(duals.weight(3) == 4);
  const auto result =
      contract_bounded(duals, duals, {{1, 9, 9, 9}, 5, 30}, last_goes{}, no_bound); // the edge (0, 1) goes
  CHECK(result.super_of_element == std::vector<local_id>{0, 0, 1, 2});
  CHECK(result.graph.edge_weights == std::vector<double>{9, 9, 1, 1});
  CHECK(result.graph.node_weights == std::vector<double>{3, 3, 4});
}

TEST_CASE("coupled sides go first, fixed ones never, penalised ones stay at a penalty") {
  const sectors around{{60, 60, 60, 60, 60, 60}, {0, 0, 0, 0, 1, 0}};
  const std::vector<coupled_side> coupled{
      {4, {{1, 2}, false}}, {2, {{1, 2}, false}}, {3, {{1, 2}, true}}, {2, {{1, 3}, false}}};
  const auto result = contracted(around, {good, 0, 0}, no_bound, coupled);
  CHECK(result.side_states == states{kept, kept, removed, refused, fixed_side, kept});
  CHECK(result.super_of_element == std::vector<local_id>{0, 1, 1, 2, 3, 4});
}

TEST_CASE("a rule sees how heavy the super-elements become") {
  const sectors around{{80, 10, 80, 80, 80, 30}, {0, 0, 0, 0, 0, 0}};
  // Spoke 1 goes for its quality, so the 10 degrees become 90; the last dihedral lies between spokes 5 and 0.
  const side_judgement judged{{1, 0, 1, 1, 1, 1}, 1, 40};
  CHECK(contract_bounded(around, around, judged, light_goes{}, no_bound).side_states ==
        states{kept, removed, kept, kept, kept, removed});
}

TEST_CASE("two elements that share two edges become one, and both edges go") {
  const sectors around{{100, 20}, {0, 0}};
  const auto result = contracted(around, {{1, 1}, 0, 30});
  CHECK(result.super_count == 1);
  CHECK(result.side_states == states{removed, removed});
}

namespace {

/// Every dihedral is met at both of its sides that are no boundary, and joined to one of the same ridge.
template <int D>
void check_joints(const simplicial_mesh<D>& mesh) {
  const auto sides = build_sides(mesh);
  const element_dual<D> edg(sides);
  const side_dual<D> sdg(mesh, sides);
  const auto ridge_of = [&](dihedral_id w) {
    const auto& local = numbering::ridges<D>[w % side_dual<D>::dihedrals_per_element];
    return sorted_vertices(detail::pick(mesh.elements[w / side_dual<D>::dihedrals_per_element], local));
  };
  std::multiset<std::pair<dihedral_id, local_id>> expected, met;
  for (dihedral_id w = 0; w < sdg.angles().size(); ++w)
    for (const local_id side : sdg.sides(w))
      if (!edg.is_fixed(side))
        expected.insert({w, side});
  for (local_id s = 0; s < static_cast<local_id>(sides.size()); ++s) {
    CHECK(edg.is_fixed(s) == !sides.is_interior(s));
    if (edg.is_fixed(s))
      continue;
    sdg.for_each_joint(s, [&](dihedral_id v, dihedral_id w) {
      met.insert({v, s});
      met.insert({w, s});
      CHECK(ridge_of(v) == ridge_of(w));
      CHECK(v / side_dual<D>::dihedrals_per_element != w / side_dual<D>::dihedrals_per_element);
    });
  }
  CHECK(met == expected);
}

} // namespace

TEST_CASE("the joints of a mesh's side-dual graph are its dihedrals around ridges") {
  check_joints(squeezed_cubes(3, 1));
  auto squares = squeezed_squares(5, 1);
  check_joints(squares);
  const auto sides = build_sides(squares);
  local_id inner = 0;
  while (!sides.is_interior(inner))
    ++inner;
  const auto edge = sides.vertices[inner];
  squares.elements.push_back({edge[0], edge[1], static_cast<local_id>(squares.points.size())});
  squares.points.push_back({0.5, 0.5, 1});
  check_joints(squares); // three triangles at an edge: no edge of the graphs
}

TEST_CASE("the graph algorithms run on a mesh's element-dual graph") {
  const auto mesh = jittered_cubes(4);
  const auto sides = build_sides(mesh);
  const std::vector<local_id> one(mesh.elements.size(), 0);
  CHECK(components_within(element_dual<3>(sides), one).count == 1);
  std::vector<std::uint8_t> fixed(sides.size(), 0); // between the lower and the upper half
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [a, b] = sides.elements[s];
    const auto half = static_cast<local_id>(mesh.elements.size() / 2);
    fixed[s] = b != no_id && (a < half) != (b < half) ? 1 : 0;
  }
  const auto halves = components_within(element_dual<3>(sides, {}, fixed), one);
  CHECK(halves.count == 2);
  CHECK(halves.of_node.front() != halves.of_node.back());
}
