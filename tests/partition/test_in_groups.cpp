// A graph partitioned in groups, each by a task.
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/in_groups.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "partition/partitioner_contract.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <concepts>
#include <set>
#include <vector>

using namespace dovetail;
using dovetail_test::element_graph;

namespace {

/// Groups as small as the contract's graphs have them.
template <graph_partitioner P>
struct small_groups : partition::in_groups<P> {
  small_groups() {
    this->nodes_per_group = 100;
    this->parts_per_group = 3;
  }
};

/// Six groups.
template <graph_partitioner P>
partition::in_groups<P> six_groups(P partitioner, any_executor run = parallel::serial{}) {
  return {.partitioner = partitioner, .run = run, .nodes_per_group = 200, .parts_per_group = 2};
}

const csr_graph& cubes() {
  static const csr_graph graph = element_graph(dovetail_test::jittered_cubes(6), 1); // 1,296 nodes
  return graph;
}

/// Cannot divide a graph with the lightest node in it, but the whole one.
struct fails_in_a_group {
  std::size_t nodes_of_whole;
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    const auto& lightest = cubes().node_weights;
    if (graph.node_weights.size() < nodes_of_whole &&
        std::count(graph.node_weights.begin(), graph.node_weights.end(),
                   *std::min_element(lightest.begin(), lightest.end())) > 0)
      throw partition_error("there is a light node");
    return partition::greedy{}(graph, parts);
  }
};

} // namespace

TEST_CASE_TEMPLATE("what is partitioned in groups satisfies the contract", P, partition::greedy,
                   partition::recursive_coordinate) {
  dovetail_test::check_partitioner_contract(small_groups<P>{}, 1.05, std::same_as<P, partition::greedy>);
}

TEST_CASE("parts in groups are the same by any executor and on any number of ranks") {
  const auto part = six_groups(partition::greedy{})(cubes(), 20);
  dovetail_test::check_partition(cubes(), part, 20, 1.05);
  CHECK(six_groups(partition::greedy{}, parallel::processes{2})(cubes(), 20) == part);
  CHECK(six_groups(partition::greedy{}, parallel::threads{3})(cubes(), 20) == part);
  for (const int ranks : {1, 2, 4})
    parallel::run_ranks(ranks, [&](parallel::in_process& mine) {
      CHECK(six_groups(partition::greedy{}, parallel::ranks(mine))(cubes(), 20) == part);
    });
}

TEST_CASE("no part is in two groups, and each group has parts by its weight") {
  const auto whole = partition::greedy{}(cubes(), 6);
  auto in_groups = six_groups(partition::greedy{});
  in_groups.imbalance = 2; // nothing is moved in the end
  const auto part = in_groups(cubes(), 30);
  std::vector<std::set<local_id>> parts(6);
  for (std::size_t v = 0; v < part.size(); ++v)
    parts[whole[v]].insert(part[v]);
  std::size_t all = 0;
  for (const auto& of_group : parts) {
    CHECK(of_group.size() == 5);
    all += of_group.size();
  }
  CHECK(all == 30);
}

TEST_CASE("a graph without two groups goes to the partitioner as it is") {
  auto in_groups = six_groups(partition::greedy{});
  CHECK(in_groups(cubes(), 3) == partition::greedy{}(cubes(), 3)); // too few parts
  in_groups.nodes_per_group = 1000;
  CHECK(in_groups(cubes(), 20) == partition::greedy{}(cubes(), 20));
}

TEST_CASE("groups cut little more than the whole") {
  const double whole = edge_cut(cubes(), partition::greedy{}(cubes(), 24));
  CHECK(edge_cut(cubes(), six_groups(partition::greedy{})(cubes(), 24)) < 1.15 * whole);
}

TEST_CASE("a group that cannot be divided is named") {
  const auto in_groups = six_groups(fails_in_a_group{cubes().node_weights.size()});
  CHECK_THROWS_WITH_AS(in_groups(cubes(), 20), doctest::Contains("of the graph: "), partition_error);
  CHECK_THROWS_WITH_AS(in_groups(cubes(), 20), doctest::Contains("there is a light node"), partition_error);
}

TEST_CASE("the graph of a group has its nodes, the edges between them, and their places") {
  const auto group = partition::greedy{}(cubes(), 5);
  const node_groups split(cubes(), group, 5);
  double inside = 0, total = 0;
  for (std::size_t g = 0; g < split.size(); ++g) {
    const csr_graph own = split.graph_of(g);
    require_valid_graph(own);
    const auto nodes = split.nodes(g);
    REQUIRE(own.node_weights.size() == nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      REQUIRE(own.node_weights[k] == cubes().node_weights[nodes[k]]);
      REQUIRE(own.positions[k] == cubes().positions[nodes[k]]);
      own.for_each_edge(static_cast<local_id>(k), [&](local_id other, double weight) {
        REQUIRE(group[nodes[other]] == static_cast<local_id>(g));
        inside += weight / 2;
      });
    }
  }
  for (const double weight : cubes().edge_weights)
    total += weight / 2;
  CHECK(inside + edge_cut(cubes(), group) == doctest::Approx(total));
}
