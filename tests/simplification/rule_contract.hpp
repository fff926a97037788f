/// @file
/// What every simplification_rule, and the contraction by it, has to satisfy; checked from the definitions.
#pragma once

#include "dovetail/graph/contraction.hpp"
#include "dovetail/simplification/angles_of_rule.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"
#include "simplification/naive_simplify.hpp"
#include "simplification/squeezed_meshes.hpp"
#include "support/adjacency.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace dovetail_test {

/// The judgement is one of this mesh, and of two sides one goes.
template <int D, dovetail::simplification_rule<D> Rule>
dovetail::side_judgement checked_judgement(const dovetail::simplicial_mesh<D>& mesh,
                                           const dovetail::side_table<D>& sides, const Rule& rule) {
  const auto judged = rule(mesh, sides);
  REQUIRE(judged.quality.size() == sides.size());
  for (const double quality : judged.quality)
    REQUIRE(quality >= 0);
  CHECK(rule(mesh, sides).quality == judged.quality);
  CHECK((judged.wanted_quality >= 0 && judged.wanted_angle_deg >= 0));
  if (judged.wanted_angle_deg > 0)
    CHECK(dovetail::wanted_angles_of<D>(rule).dihedral_deg == judged.wanted_angle_deg);
  for (dovetail::local_id s = 1; s < static_cast<dovetail::local_id>(sides.size()); ++s) {
    const dovetail::dihedral_side a{s - 1, judged.quality[static_cast<std::size_t>(s) - 1], 2};
    const dovetail::dihedral_side b{s, judged.quality[s], 3};
    REQUIRE(rule.prefer_removal(a, b) != rule.prefer_removal(b, a));
  }
  for (const double value : {0.0, 0.3, 0.9})
    CHECK(rule.penalty({value, 1.0}) > 0);
  return judged;
}

/// Every side that the rule wants gone is, or the bound refused it, or it is fixed; every dihedral that is
/// too small afterwards lies between fixed sides or touches a refused one.
template <int D>
void check_wishes(const dovetail::simplicial_mesh<D>& mesh, const dovetail::side_judgement& judged,
                  const dovetail::simplification& result) {
  using namespace dovetail;
  const auto adj = dovetail_test::build_adjacency(mesh);
  std::vector<bool> gone(adj.sides.size());
  std::size_t refused = 0;
  for (std::size_t s = 0; s < gone.size(); ++s) {
    gone[s] = result.side_states[s] == side_state::removed;
    refused += result.side_states[s] == side_state::refused ? 1 : 0;
    if (judged.quality[s] < judged.wanted_quality)
      REQUIRE(result.side_states[s] != side_state::kept);
  }
  CHECK(result.refused.size() == refused);
  std::size_t forced = 0;
  for (const naive_dihedral& w : remaining_dihedrals(mesh, adj, gone)) {
    if (!(w.angle < judged.wanted_angle_deg))
      continue;
    const auto from = result.side_states[w.from];
    const auto to = result.side_states[w.to];
    const bool both_fixed = from == side_state::fixed && to == side_state::fixed;
    REQUIRE((both_fixed || from == side_state::refused || to == side_state::refused));
    forced += both_fixed ? 1 : 0;
  }
  CHECK(result.forced.size() == forced);
}

/// Fixed sides stay, super-elements are connected and what lies inside them is removed, none is too heavy.
template <int D>
void check_contraction(const dovetail::simplicial_mesh<D>& mesh, const dovetail::side_table<D>& sides,
                       const dovetail::simplification& result) {
  using namespace dovetail;
  std::vector<std::uint8_t> fixed(sides.size(), 0);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [a, b] = sides.elements[s];
    const bool inside = sides.is_interior(static_cast<local_id>(s));
    const bool changes = inside && !mesh.tags.empty() && mesh.tags[a] != mesh.tags[b];
    fixed[s] = changes ? 1 : 0;
    REQUIRE((result.side_states[s] == side_state::fixed) == (!inside || changes));
    if (inside && !changes) {
      const bool one = result.super_of_element[a] == result.super_of_element[b];
      REQUIRE(one == (result.side_states[s] == side_state::removed));
    }
  }
  const auto found = components_within(element_dual<D>(sides, {}, fixed), result.super_of_element);
  CHECK(found.count == result.super_count);
  CHECK(found.of_node == result.super_of_element); // both are numbered by their first element
  for (const double weight : result.graph.node_weights)
    CHECK(weight <= result.summary.get("weight_bound"));
}

template <int D, dovetail::simplification_rule<D> Rule>
void check_rule_on(const dovetail::simplicial_mesh<D>& mesh, const Rule& rule) {
  using namespace dovetail;
  const auto sides = build_sides(mesh);
  const auto judged = checked_judgement(mesh, sides, rule);
  for (const double fraction : {0.1, 0.5, unbounded}) {
    const contraction_bound bound{.subdomains = 8, .fraction = fraction};
    const auto result = simplify<D>(mesh, mesh_duals<D>(mesh, sides), rule, bound);
    check_contraction(mesh, sides, result);
    check_wishes(mesh, judged, result);
    const auto again = simplify<D>(mesh, mesh_duals<D>(mesh, sides), rule, bound);
    CHECK(again.side_states == result.side_states);
    CHECK(again.super_of_element == result.super_of_element);
    CHECK(again.graph.edge_weights == result.graph.edge_weights);
  }
}

/// The volume's result coupled to the surface's: every interior face at an edge from which the rule
/// propagates is removed or refused.
template <class Rule>
void check_coupling(const dovetail::simplicial_mesh<3>& volume, const Rule& rule) {
  using namespace dovetail;
  const auto sides = build_sides(volume);
  simplicial_mesh<2> surface;
  surface.points = volume.points;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      surface.elements.push_back(sides.vertices[s]);
  const auto edges = build_sides(surface);
  const auto result = simplify_coupled({surface}, {volume, sides}, rule, {.subdomains = 16});
  check_contraction(volume, sides, result.volume);
  std::vector<simplex<1>> coupled;
  for (const auto& ridge : coupled_ridges(edges, result.surface, rule))
    coupled.push_back(sorted_vertices(ridge.vertices));
  sort_all(coupled);
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (const auto& local : numbering::sides<2>)
      if (std::binary_search(coupled.begin(), coupled.end(),
                             sorted_vertices(detail::pick(sides.vertices[s], local))))
        CHECK(result.volume.side_states[s] != side_state::kept);
}

/// All of it, on random meshes.
template <class Rule>
void check_rule(const Rule& rule) {
  static_assert(dovetail::simplification_rule<Rule, 2> && dovetail::simplification_rule<Rule, 3>);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    auto cubes = squeezed_cubes(5, seed);
    auto squares = squeezed_squares(20, seed);
    check_coupling(cubes, rule);
    if (seed > 1) {
      give_two_tags(cubes);
      give_two_tags(squares);
    }
    check_rule_on<3>(cubes, rule);
    check_rule_on<2>(squares, rule);
  }
  // Three sheets at an edge.
  dovetail::simplicial_mesh<2> fins;
  fins.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.3, 0}, {0.5, 0, 0.3}, {0.5, -0.3, 0}, {0, 0.3, 0}};
  fins.elements = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 2, 5}};
  check_rule_on<2>(fins, rule);
}

} // namespace dovetail_test
