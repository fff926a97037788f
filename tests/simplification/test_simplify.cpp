#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/side_shape.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"
#include "simplification/naive_simplify.hpp"
#include "simplification/squeezed_meshes.hpp"
#include "support/adjacency.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

using namespace dovetail;
using namespace dovetail_test;

namespace {

template <int D>
std::vector<bool> fixed_sides(const simplicial_mesh<D>& mesh, const side_table<D>& sides) {
  std::vector<bool> fixed(sides.size());
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [a, b] = sides.elements[s];
    fixed[s] =
        !sides.is_interior(static_cast<local_id>(s)) || (!mesh.tags.empty() && mesh.tags[a] != mesh.tags[b]);
  }
  return fixed;
}

std::vector<double> random_weights(std::size_t count, std::uint64_t seed) {
  random_numbers random(seed);
  std::vector<double> weights(count);
  for (double& w : weights)
    w = static_cast<double>(1 + random.bits() % 8); // whole numbers: sums do not depend on their order
  return weights;
}

template <int D>
void compare_with_naive(const simplicial_mesh<D>& mesh, double bound_fraction, std::uint64_t seed) {
  const auto adj = dovetail_test::build_adjacency(mesh);
  const auto weights = random_weights(mesh.elements.size(), seed);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const simplifier::paper rule;
  const auto fast = simplify<D>(mesh, mesh_duals<D>(mesh, adj.sides, {.element_weights = weights}), rule,
                                {.fraction = bound_fraction, .always_allowed_elements = 0});
  const auto naive =
      naive_simplify<D>(mesh, adj, fixed_sides(mesh, adj.sides), weights, bound_fraction * total,
                        D == 2 ? rule.surface_shape_deg : rule.volume_shape_deg,
                        D == 2 ? rule.surface_dihedral_deg : rule.volume_dihedral_deg);
  CHECK(fast.side_states == naive.states);
  // The same classes of elements: naive labels are smallest members, fast ones are numbered in that order.
  std::map<local_id, local_id> renamed;
  for (const local_id label : naive.super)
    renamed.emplace(label, 0);
  local_id next = 0;
  for (auto& [label, number] : renamed)
    number = next++;
  std::vector<local_id> expected;
  for (const local_id label : naive.super)
    expected.push_back(renamed[label]);
  CHECK(fast.super_of_element == expected);
  CHECK(fast.super_count == next);
}

/// Simplifies and partitions a mesh that comes from no CAD model.
template <int D>
void simplify_and_partition(const simplicial_mesh<D>& mesh) {
  const mesh_duals<D> duals(mesh);
  const auto simplified = simplify<D>(mesh, duals, simplifier::paper{}, {.subdomains = 4});
  CHECK(simplified.super_count < static_cast<local_id>(mesh.elements.size()));
  const auto pieces = decompose<D>(mesh, duals.sides(), simplified.super_of_element, simplified.graph,
                                   mesh.tags, partition::greedy{}, 4);
  CHECK(pieces.parts == 4);
  for (std::size_t s = 0; s < duals.sides().size(); ++s)
    if (simplified.side_states[s] == side_state::removed) {
      const auto [a, b] = duals.sides().elements[s];
      CHECK(pieces.part_of_element[a] == pieces.part_of_element[b]);
    }
  // Its element-dual graph is a graph like any other.
  const auto part = partition::greedy{}(duals.elements(), 4);
  CHECK(imbalance_of(duals.elements(), part, 4) < 1.05);
}

} // namespace

TEST_CASE("a mesh without a CAD model is simplified and partitioned, of triangles or tetrahedra") {
  simplify_and_partition<2>(squeezed_squares(16, 3));
  simplify_and_partition<3>(squeezed_cubes(6, 3));
}

TEST_CASE("the fast simplification equals the naive one, D = 3") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const double bound : {unbounded, 0.5, 0.05, 0.01}) {
      CAPTURE(seed);
      CAPTURE(bound);
      auto mesh = squeezed_cubes(3, seed, 0.6);
      if (seed % 2 == 0)
        give_two_tags(mesh);
      compare_with_naive(mesh, bound, seed);
    }
}

TEST_CASE("the fast simplification equals the naive one, D = 2") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const double bound : {unbounded, 0.1, 0.02}) {
      CAPTURE(seed);
      CAPTURE(bound);
      auto mesh = squeezed_squares(9, seed);
      if (seed % 2 == 0)
        give_two_tags(mesh);
      compare_with_naive(mesh, bound, seed);
    }
}

TEST_CASE("a mesh without bad angles is left as it is") {
  // Equilateral triangles: all corners 60 degrees.
  simplicial_mesh<2> mesh;
  const double h = std::sqrt(3.0) / 2;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i)
      mesh.points.push_back({i + 0.5 * j, h * j, 0});
  for (local_id j = 0; j < 4; ++j)
    for (local_id i = 0; i < 4; ++i) {
      const local_id a = 5 * j + i;
      mesh.elements.push_back({a, a + 1, a + 5});
      mesh.elements.push_back({a + 1, a + 6, a + 5});
    }
  const auto result = simplify<2>(mesh, mesh_duals<2>(mesh), simplifier::paper{});
  CHECK(result.super_count == static_cast<local_id>(mesh.elements.size()));
  CHECK(result.summary.get("removed_sides") == 0);
}

TEST_CASE("weights of the contracted graph: merged elements and merged sides, refused ones dearer") {
  const auto mesh = squeezed_cubes(5, 3);
  const auto sides = build_sides(mesh);
  const auto weights = random_weights(mesh.elements.size(), 4);
  const simplifier::paper rule;
  const auto result =
      simplify<3>(mesh, mesh_duals<3>(mesh, sides, {.element_weights = weights}), rule, {.subdomains = 8});
  REQUIRE(result.refused.size() > 0);
  std::vector<double> node_weights(static_cast<std::size_t>(result.super_count), 0.0);
  for (std::size_t e = 0; e < weights.size(); ++e)
    node_weights[result.super_of_element[e]] += weights[e];
  CHECK(result.graph.node_weights == node_weights);
  const double bound = result.summary.get("weight_bound");
  for (const double w : node_weights)
    CHECK(w <= bound);

  std::map<local_id, refused_side> refusals;
  for (const refused_side& r : result.refused)
    refusals[r.side] = r;
  std::map<std::pair<local_id, local_id>, double> expected;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (!sides.is_interior(static_cast<local_id>(s)))
      continue;
    local_id a = result.super_of_element[sides.elements[s][0]];
    local_id b = result.super_of_element[sides.elements[s][1]];
    if (a == b)
      continue;
    double weight = 1;
    if (const auto found = refusals.find(static_cast<local_id>(s)); found != refusals.end()) {
      weight +=
          rule.penalty_of_refusal.base +
          rule.penalty_of_refusal.growth * (1 - found->second.missed.value / found->second.missed.wanted);
      CHECK(weight > 1);
    }
    expected[{std::min(a, b), std::max(a, b)}] += weight;
  }
  std::size_t edges = 0;
  for (local_id v = 0; v < result.graph.node_count(); ++v) {
    const auto row = result.graph.row(v);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const auto slot = static_cast<std::size_t>(result.graph.offsets[v]) + k;
      CHECK(result.graph.edge_weights[slot] ==
            doctest::Approx(expected.at({std::min(v, row[k]), std::max(v, row[k])})));
      ++edges;
    }
  }
  CHECK(edges == 2 * expected.size());
}

TEST_CASE("given sides are fixed in any order of their vertices") {
  const auto mesh = squeezed_squares(10, 1);
  const auto sides = build_sides(mesh);
  const auto free = simplify<2>(mesh, mesh_duals<2>(mesh, sides), simplifier::paper{});
  std::vector<simplex<1>> given;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (free.side_states[s] == side_state::removed && given.size() < 20)
      given.push_back({sides.vertices[s][1], sides.vertices[s][0]});
  REQUIRE(given.size() == 20);
  const auto result =
      simplify<2>(mesh, mesh_duals<2>(mesh, sides, {.fixed_sides = given}), simplifier::paper{});
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (std::find(given.begin(), given.end(), simplex<1>{sides.vertices[s][1], sides.vertices[s][0]}) !=
        given.end())
      CHECK(result.side_states[s] == side_state::fixed);
}

TEST_CASE("removing a surface edge removes all interior faces at it") {
  const auto volume = squeezed_cubes(5, 2, 0.8);
  const auto sides = build_sides(volume);
  simplicial_mesh<2> surface;
  surface.points = volume.points;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      surface.elements.push_back(sides.vertices[s]);
  const auto edges = build_sides(surface);
  const auto no_bound =
      simplify_coupled({surface}, {volume, sides}, simplifier::paper{}, {.fraction = unbounded});
  std::size_t removed = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (no_bound.surface.side_states[k] != side_state::removed)
      continue;
    ++removed;
    const auto edge = sorted_vertices(edges.vertices[k]);
    for (std::size_t s = 0; s < sides.size(); ++s)
      for (const auto& local : numbering::sides<2>)
        if (sorted_vertices(detail::pick(sides.vertices[s], local)) == edge &&
            sides.is_interior(static_cast<local_id>(s)))
          CHECK(no_bound.volume.side_states[s] == side_state::removed);
  }
  CHECK(removed > 10);

  // With a bound on both, what is not removed there is refused.
  const auto bounded = simplify_coupled({surface}, {volume, sides}, simplifier::paper{}, {.subdomains = 16});
  REQUIRE(bounded.volume.refused.size() > 0);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto state = bounded.surface.side_states[k];
    if (state != side_state::removed && state != side_state::refused)
      continue;
    const auto edge = sorted_vertices(edges.vertices[k]);
    for (std::size_t s = 0; s < sides.size(); ++s)
      for (const auto& local : numbering::sides<2>)
        if (sorted_vertices(detail::pick(sides.vertices[s], local)) == edge)
          CHECK(bounded.volume.side_states[s] != side_state::kept);
  }
}

TEST_CASE("a side between elements that are one already is removed whatever the bound") {
  // Three triangles around a point, the bound allows three elements: the last side is internal.
  simplicial_mesh<2> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}};
  mesh.elements = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
  const auto result = simplify<2>(mesh, mesh_duals<2>(mesh), simplifier::paper{.surface_dihedral_deg = 130},
                                  {.fraction = 1, .always_allowed_elements = 0});
  CHECK(result.super_count == 1);
  CHECK(result.summary.get("refused_sides") == 0);
  CHECK(result.summary.get("removed_sides") == 3);
}

TEST_CASE("no small dihedral is left inside where sides that were only penalised have become internal") {
  const simplifier::paper rule{.volume_dihedral_deg = 80};
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    const auto mesh = squeezed_cubes(5, seed, 0.7);
    const auto adj = dovetail_test::build_adjacency(mesh);
    const mesh_duals<3> duals(mesh, adj.sides);
    random_numbers random(seed);
    std::vector<coupled_side> penalised;
    for (std::size_t s = 0; s < adj.sides.size(); ++s)
      if (adj.sides.is_interior(static_cast<local_id>(s)) && random.bits() % 4 == 0)
        penalised.push_back(
            {static_cast<local_id>(s), {.missed = {.value = 10, .wanted = 30}, .only_penalise = true}});
    const auto result = contract_bounded(duals.elements(), duals.dihedrals(), rule(mesh, adj.sides), rule,
                                         {.fraction = unbounded}, penalised);
    const auto is = [&](local_id side, side_state state) { return result.side_states[side] == state; };
    std::vector<bool> gone(adj.sides.size());
    for (std::size_t s = 0; s < gone.size(); ++s)
      gone[s] = is(static_cast<local_id>(s), side_state::removed);
    for (const naive_dihedral& left : remaining_dihedrals<3>(mesh, adj, gone)) {
      const bool is_fixed = is(left.from, side_state::fixed) && is(left.to, side_state::fixed);
      const bool is_refused = is(left.from, side_state::refused) || is(left.to, side_state::refused);
      CHECK((left.angle >= rule.volume_dihedral_deg - 1e-6 || is_fixed || is_refused));
    }
  }
}

TEST_CASE("the result is the same every time and for empty meshes") {
  const auto mesh = squeezed_cubes(6, 5);
  const auto sides = build_sides(mesh);
  const auto first = simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::paper{}, {.subdomains = 16});
  const auto second = simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::paper{}, {.subdomains = 16});
  CHECK(first.side_states == second.side_states);
  CHECK(first.super_of_element == second.super_of_element);
  const simplicial_mesh<3> empty;
  CHECK(simplify<3>(empty, mesh_duals<3>(empty), simplifier::paper{}).super_count == 0);
}

TEST_CASE("a wrong number of weights is refused") {
  const auto mesh = squeezed_squares(3, 1);
  const std::vector<double> weights(5, 1.0);
  CHECK_THROWS_AS(simplify<2>(mesh, mesh_duals<2>(mesh, {.element_weights = weights}), simplifier::paper{}),
                  usage_error);
}

TEST_CASE(
    "The shape of a side is its smallest corner, of an edge the smallest angle of a triangle at its ends") {
  // A right triangle of 30 and 60 degrees, and an equilateral one on its longer leg.
  const double leg = std::sqrt(3.0);
  simplicial_mesh<2> triangles{
      {{0, 0, 0}, {leg, 0, 0}, {0, 1, 0}, {leg / 2, -1.5, 0}}, {{0, 1, 2}, {1, 0, 3}}, {}};
  const auto edges = build_sides(triangles);
  const auto of_edges = side_shapes(triangles, edges);
  for (std::size_t s = 0; s < edges.size(); ++s) {
    const auto [a, b] = edges.vertices[s];
    const bool has_smallest = a == 1 || b == 1; // the corner of 30 degrees
    const bool of_equilateral_alone = a == 3 || b == 3;
    CHECK(of_edges[s] == doctest::Approx(of_equilateral_alone || !has_smallest ? 60 : 30));
  }
  simplicial_mesh<3> tetrahedron{{{0, 0, 0}, {leg, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
  const auto faces = build_sides(tetrahedron);
  const auto of_faces = side_shapes(tetrahedron, faces);
  for (std::size_t s = 0; s < faces.size(); ++s) {
    const auto& face = faces.vertices[s];
    const auto has = [&](local_id v) { return std::find(face.begin(), face.end(), v) != face.end(); };
    const double expected = !has(0)   ? 2 * std::asin(std::sqrt(2.0) / 4) * 180 / std::numbers::pi
                            : !has(1) ? 45
                                      : 30;
    CHECK(of_faces[s] == doctest::Approx(expected));
  }
}
