// Partitioners of graphs whose rows are spread over ranks.
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/self.hpp"
#include "dovetail/partition/any_distributed_partitioner.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "partition/partitioner_contract.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace dovetail;
using dovetail_test::element_graph;

namespace {

/// A result that another one has been changed to.
struct changed {
  void (*change)(std::vector<local_id>&);
  static constexpr bool depends_on_ranks() { return true; }
  std::vector<local_id> operator()(any_communicator& network, const distributed_csr_graph& graph,
                                   int parts) const {
    auto part = partition::gathered{partition::greedy{}}(network, graph, parts);
    if (network.rank() == network.size() - 1)
      change(part);
    return part;
  }
};

} // namespace

TEST_CASE("gathered gives what its partitioner gives alone, on any number of ranks") {
  const csr_graph cubes = element_graph(dovetail_test::jittered_cubes(5), 1);
  const csr_graph three = dovetail_test::graph_on_circle({1, 2, 3}, {{0, 1, 1}}); // some ranks have no node
  for (const int ranks : {1, 2, 4})
    parallel::run_ranks(ranks, [&](parallel::in_process& mine) {
      any_communicator network(mine);
      const any_distributed_partitioner spread = partition::greedy{};
      CHECK_FALSE(spread.depends_on_ranks());
      CHECK(spread.of_whole(network, cubes, 7) == partition::greedy{}(cubes, 7));
      CHECK(spread.of_whole(network, three, 2) == partition::greedy{}(three, 2));
      const partition::recursive_coordinate by_place; // goes by positions
      CHECK(any_distributed_partitioner(by_place).of_whole(network, cubes, 5) == by_place(cubes, 5));
      CHECK_THROWS_AS(spread.of_whole(network, three, 4), partition_error);
    });
}

TEST_CASE("what partitions on rank 0 alone takes a graph that all ranks have as it is there") {
  const csr_graph whole = element_graph(dovetail_test::jittered_cubes(4), 1);
  for (const int ranks : {1, 3})
    parallel::run_ranks(ranks, [&](parallel::in_process& mine) {
      any_communicator network(mine);
      const any_distributed_partitioner by_halves = [&](const csr_graph& graph, int) {
        CHECK(&graph == &whole);
        CHECK(mine.rank() == 0);
        std::vector<local_id> part(graph.node_weights.size(), 0);
        std::fill(part.begin() + graph.node_count() / 2, part.end(), 1);
        return part;
      };
      const auto part = by_halves.of_whole(network, whole, 2);
      CHECK(part.size() == whole.node_weights.size());
      CHECK(part.front() == 0);
      CHECK(part.back() == 1);
      CHECK_THROWS_WITH_AS(by_halves.of_whole(network, whole, 3), doctest::Contains("without a node"),
                           partition_error);
    });
}

TEST_CASE("each rank has the rows of its nodes, and gets the parts of these") {
  const csr_graph whole = element_graph(dovetail_test::jittered_cubes(4), 2);
  const auto part = partition::greedy{}(whole, 3);
  parallel::run_ranks(4, [&](parallel::in_process& mine) {
    any_communicator network(mine);
    const distributed_csr_graph share = rows_of_rank(whole, network.rank(), 4);
    CHECK(share.node_count() == whole.node_count());
    CHECK(share.rows.node_count() == share.end() - share.first());
    for (local_id v = share.first(); v < share.end(); ++v) {
      const auto here = share.rows.row(v - share.first()), there = whole.row(v);
      CHECK(std::equal(here.begin(), here.end(), there.begin(), there.end()));
    }
    CHECK(partition::gathered{partition::greedy{}}(network, share, 3) ==
          std::vector<local_id>(part.begin() + share.first(), part.begin() + share.end()));
    const csr_graph again = gather_rows(network, share);
    if (network.leads()) {
      CHECK(again.offsets == whole.offsets);
      CHECK(again.edge_weights == whole.edge_weights);
      CHECK(again.positions.size() == whole.positions.size());
    } else {
      CHECK(again.node_count() == 0);
    }
  });
}

TEST_CASE("a result that is none is refused on all ranks") {
  const csr_graph graph = element_graph(dovetail_test::jittered_cubes(3));
  const auto refused = [&](void (*change)(std::vector<local_id>&), const char* why) {
    parallel::run_ranks(3, [&](parallel::in_process& mine) {
      any_communicator network(mine);
      const any_distributed_partitioner spread(changed{change}, "mine");
      CHECK(spread.depends_on_ranks());
      CHECK_THROWS_WITH_AS(spread.of_whole(network, graph, 3), doctest::Contains(why), partition_error);
    });
  };
  refused([](std::vector<local_id>& part) { part.pop_back(); },
          "the partitioner 'mine' put 161 nodes into parts, the graph has 162");
  refused([](std::vector<local_id>& part) { part.back() = 3; }, "'mine' put node 161 into part 3 of 3");
}
