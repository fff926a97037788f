/// The balancing of native partitioners against the rules that it follows, written down without queues.
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "dovetail/partition/refinement.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <tuple>

using namespace dovetail;
using dovetail_test::random_numbers;

namespace {

std::size_t at(local_id id) {
  return static_cast<std::size_t>(id);
}

/// A connected graph: a path and some chords. Small whole weights make ties; some nodes weigh nothing.
csr_graph random_graph(random_numbers& random, int nodes, bool ties) {
  const auto weight = [&](int most) {
    return ties ? static_cast<double>(random.bits() % static_cast<std::uint64_t>(most)) : 5 * random.unit();
  };
  std::vector<double> weights;
  std::vector<weighted_edge> edges;
  for (local_id v = 0; v < nodes; ++v) {
    weights.push_back(weight(4));
    if (v > 0)
      edges.push_back({v - 1, v, 1 + weight(3)});
    for (int k = 0; k < 2; ++k)
      if (const auto w = static_cast<local_id>(random.bits() % static_cast<std::uint64_t>(nodes)); w != v)
        edges.push_back({v, w, weight(3)}); // some weigh nothing
  }
  weights[0] = 1;
  return make_csr_graph(std::move(weights), edges);
}

/// Unbalanced: most nodes are in the first parts; none is empty.
std::vector<local_id> random_parts(random_numbers& random, std::size_t nodes, int parts) {
  std::vector<local_id> part(nodes);
  for (std::size_t v = 0; v < nodes; ++v)
    part[v] = v < at(parts) ? static_cast<local_id>(v)
                            : static_cast<local_id>(random.unit() * random.unit() * random.unit() * parts);
  return part;
}

struct move {
  local_id node = no_id;
  local_id to = no_id;
  double gain = 0; ///< per weight
};

/// The best of all moves that make a pair of parts more even, by the rule as it is documented.
move best_move(const csr_graph& graph, const std::vector<local_id>& part, const std::vector<double>& weights,
               const std::vector<double>& limits, local_id from) {
  move best;
  for (local_id v = 0; v < graph.node_count(); ++v) {
    const double w = graph.node_weights[v];
    if (part[v] != from || w <= 0)
      continue;
    for (local_id to = 0; at(to) < weights.size(); ++to) {
      double inside = 0;
      double outside = 0;
      bool is_beside = false;
      for (std::size_t k = 0; k < graph.row(v).size(); ++k) {
        const local_id p = part[graph.row(v)[k]];
        const double edge = graph.edge_weights[static_cast<std::size_t>(graph.offsets[v]) + k];
        inside += p == from ? edge : 0;
        outside += p == to ? edge : 0;
        is_beside = is_beside || p == to;
      }
      const bool fits = (weights[to] + w) / limits[to] < weights[from] / limits[from] * (1 - 1e-12);
      if (to == from || !is_beside || !fits)
        continue;
      const move m{v, to, (outside - inside) / w};
      const auto key = [&](const move& x) { return std::tuple(-x.gain, weights[x.to], x.to); };
      if (best.node == no_id || key(m) < key(best))
        best = m;
    }
  }
  return best;
}

void balance_slowly(const csr_graph& graph, std::vector<local_id>& part, const std::vector<double>& limits) {
  const auto parts = static_cast<int>(limits.size());
  auto weights = part_weights(graph, part, parts);
  while (true) {
    const auto relative = [&](local_id p) { return weights[p] / limits[p]; };
    local_id heaviest = 0;
    for (local_id p = 1; p < parts; ++p)
      if (relative(p) > relative(heaviest))
        heaviest = p;
    if (relative(heaviest) <= 1 || std::count(part.begin(), part.end(), heaviest) < 2)
      return;
    const move best = best_move(graph, part, weights, limits, heaviest);
    if (best.node == no_id)
      return;
    part[best.node] = best.to;
    weights[heaviest] -= graph.node_weights[best.node];
    weights[best.to] += graph.node_weights[best.node];
  }
}

} // namespace

TEST_CASE("balancing makes the moves of its rule, ties included") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    random_numbers random(seed);
    const int parts = 2 + static_cast<int>(seed % 7);
    const csr_graph graph = random_graph(random, 20 + static_cast<int>(seed), seed % 2 == 0);
    std::vector<local_id> part = random_parts(random, graph.node_weights.size(), parts);
    auto limits = equal_limits(graph, parts, 1.03);
    for (double& limit : limits)
      limit *= 0.8 + 0.4 * random.unit();
    auto expected = part;
    balance_slowly(graph, expected, limits);
    movable_parts movable(graph, part, limits);
    part_balancer(movable).run();
    CHECK(part == expected);
    CHECK(movable.weight(0) == doctest::Approx(part_weights(graph, part, parts)[0]));
  }
}

TEST_CASE("refinement worsens neither a cut nor an excess, and empties no part") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    random_numbers random(seed);
    const int parts = 2 + static_cast<int>(seed % 7);
    const csr_graph graph = random_graph(random, 30 + static_cast<int>(seed), seed % 2 == 0);
    std::vector<local_id> part = random_parts(random, graph.node_weights.size(), parts);
    const auto limits = equal_limits(graph, parts, 1.2);
    const auto heaviest = [&] {
      const auto weights = part_weights(graph, part, parts);
      return *std::max_element(weights.begin(), weights.end());
    };
    const double before = heaviest();
    partition_refiner(graph, part, limits).refine(0);
    const double balanced = heaviest();
    const double cut = edge_cut(graph, part);
    CHECK(balanced <= before);
    partition_refiner(graph, part, limits).refine();
    CHECK(heaviest() <= std::max(balanced, limits[0]));
    CHECK(edge_cut(graph, part) <= cut + 1e-9);
    for (local_id p = 0; p < parts; ++p)
      CHECK(std::count(part.begin(), part.end(), p) > 0);
  }
}

TEST_CASE("every empty part gets the heaviest node of the heaviest part that has two") {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    random_numbers random(seed);
    const csr_graph graph = random_graph(random, 40, seed % 2 == 0);
    std::vector<local_id> part(40);
    for (local_id& p : part)
      p = static_cast<local_id>(3 * (random.bits() % 4));
    auto expected = part;
    for (local_id empty = 0; empty < 12; ++empty) {
      const auto count = [&](local_id p) { return std::count(expected.begin(), expected.end(), p); };
      if (count(empty) > 0)
        continue;
      const auto weights = part_weights(graph, expected, 12);
      local_id donor = no_id;
      for (local_id p = 0; p < 12; ++p)
        if (count(p) > 1 && (donor == no_id || weights[p] > weights[donor] + 1e-12))
          donor = p;
      std::size_t given = 40;
      for (std::size_t v = 0; v < 40; ++v)
        if (expected[v] == donor && (given == 40 || graph.node_weights[v] > graph.node_weights[given]))
          given = v;
      expected[given] = empty;
    }
    detail::fill_empty_parts(graph, part, 12);
    CHECK(part == expected);
  }
}

TEST_CASE("leveling reaches what is allowed even without an edge") {
  random_numbers random(3);
  std::vector<double> weights;
  for (int v = 0; v < 60; ++v)
    weights.push_back(0.1 + random.unit());
  const csr_graph graph = make_csr_graph(weights, {});
  std::vector<local_id> part(60, 2);
  detail::level_parts(graph, part, 7, 1.01);
  const auto made = part_weights(graph, part, 7);
  CHECK(*std::max_element(made.begin(), made.end()) <=
        detail::allowed_part_weight(graph, 7, 1.01) * (1 + 1e-9));
}
