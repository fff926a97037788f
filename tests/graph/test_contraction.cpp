#include "dovetail/core/error.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <map>

using namespace dovetail;

namespace {

struct random_graph {
  std::vector<double> node_weights;
  std::vector<weighted_edge> edges;
};

random_graph make_random(std::uint64_t seed) {
  dovetail_test::random_numbers random(seed);
  random_graph g;
  const std::size_t n = 5 + random.bits() % 40;
  for (std::size_t v = 0; v < n; ++v)
    g.node_weights.push_back(static_cast<double>(1 + random.bits() % 9));
  for (std::size_t k = 0; k < 3 * n; ++k)
    g.edges.push_back({static_cast<local_id>(random.bits() % n), static_cast<local_id>(random.bits() % n),
                       static_cast<double>(1 + random.bits() % 5)});
  return g;
}

std::map<std::pair<local_id, local_id>, double> as_map(const csr_graph& g) {
  std::map<std::pair<local_id, local_id>, double> entries;
  for (local_id v = 0; v < g.node_count(); ++v) {
    const auto row = g.row(v);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const auto slot = static_cast<std::size_t>(g.offsets[v]) + k;
      REQUIRE(entries.emplace(std::pair(v, row[k]), g.edge_weights[slot]).second);
    }
  }
  return entries;
}

} // namespace

TEST_CASE("a graph made from a list equals the map of its edges") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const random_graph g = make_random(seed);
    std::map<std::pair<local_id, local_id>, double> expected;
    for (const weighted_edge& e : g.edges)
      if (e.a != e.b) {
        expected[{e.a, e.b}] += e.weight;
        expected[{e.b, e.a}] += e.weight;
      }
    const csr_graph csr = make_csr_graph(g.node_weights, g.edges);
    CHECK(as_map(csr) == expected);
    CHECK(csr.node_weights == g.node_weights);
  }
}

TEST_CASE("contraction adds node weights and merged edges") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const random_graph g = make_random(seed);
    dovetail_test::random_numbers random(seed + 1000);
    const local_id labels = 4;
    std::vector<local_id> label(g.node_weights.size());
    for (local_id& l : label)
      l = static_cast<local_id>(random.bits() % labels);
    std::map<std::pair<local_id, local_id>, double> expected;
    std::vector<double> weights(labels, 0.0);
    for (std::size_t v = 0; v < label.size(); ++v)
      weights[label[v]] += g.node_weights[v];
    for (const weighted_edge& e : g.edges) {
      const local_id a = label[e.a];
      const local_id b = label[e.b];
      if (a != b) {
        expected[{a, b}] += e.weight;
        expected[{b, a}] += e.weight;
      }
    }
    const csr_graph contracted = contract(make_csr_graph(g.node_weights, g.edges), label, labels);
    CHECK(as_map(contracted) == expected);
    CHECK(contracted.node_weights == weights);
  }
}

TEST_CASE("components within labels are connected, maximal and numbered by their first node") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const random_graph g = make_random(seed);
    const csr_graph csr = make_csr_graph(g.node_weights, g.edges);
    std::vector<local_id> label(g.node_weights.size());
    for (std::size_t v = 0; v < label.size(); ++v)
      label[v] = static_cast<local_id>(v % 3);
    disjoint_sets sets(label.size());
    for (const weighted_edge& e : g.edges)
      if (label[e.a] == label[e.b])
        sets.unite(e.a, e.b);
    const auto expected = sets.number_sets();
    const auto found = components_within(csr, label);
    CHECK(found.of_node == expected.of_member);
    CHECK(found.count == expected.count);
  }
}

TEST_CASE("an induced subgraph keeps exactly the edges among its nodes") {
  const random_graph g = make_random(7);
  const csr_graph csr = make_csr_graph(g.node_weights, g.edges);
  std::vector<local_id> label(g.node_weights.size());
  for (std::size_t v = 0; v < label.size(); ++v)
    label[v] = static_cast<local_id>(v % 2);
  const subgraph odd = induced_subgraph(csr, label, 1);
  std::map<std::pair<local_id, local_id>, double> expected;
  for (const auto& [ends, weight] : as_map(csr))
    if (ends.first % 2 == 1 && ends.second % 2 == 1)
      expected[ends] = weight;
  std::map<std::pair<local_id, local_id>, double> renamed;
  for (const auto& [ends, weight] : as_map(odd.graph))
    renamed[{odd.nodes[ends.first], odd.nodes[ends.second]}] = weight;
  CHECK(renamed == expected);
}

TEST_CASE("disjoint sets carry weights and are named by their smallest member") {
  disjoint_sets sets(std::vector<double>{1, 2, 4, 8});
  CHECK(sets.unite(3, 1));
  CHECK(sets.unite(2, 3));
  CHECK_FALSE(sets.unite(1, 2));
  CHECK(sets.find(3) == 1);
  CHECK(sets.weight(2) == 14);
  CHECK(sets.number_sets().of_member == std::vector<local_id>{0, 1, 1, 1});
}

TEST_CASE("an edge that leaves the graph is refused") {
  const std::vector<weighted_edge> edges{{0, 5, 1}};
  CHECK_THROWS_AS(make_csr_graph({1, 1}, edges), usage_error);
}
