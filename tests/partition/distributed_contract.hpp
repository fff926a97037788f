/// @file
/// What every distributed_graph_partitioner has to satisfy over MPI: that of a partitioner, with its graph
/// spread over the ranks.
#pragma once

#include "dovetail/parallel/in_process.hpp"
#include "dovetail/partition/any_distributed_partitioner.hpp"
#include "partition/partitioner_contract.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace dovetail_test {

/// A graph_partitioner that all ranks call with the same graph.
template <dovetail::distributed_graph_partitioner P>
struct over_ranks {
  dovetail::any_communicator* network;
  P policy = {};
  double imbalance = 1.03;

  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph& graph, int parts) const {
    P asked = policy;
    asked.imbalance = imbalance;
    return dovetail::any_distributed_partitioner(asked, "checked").of_whole(*network, graph, parts);
  }
};

template <class P>
void check_distributed_partitioner(dovetail::any_communicator& network) {
  check_partitioner_contract(over_ranks<P>{&network}, 1.03);
  SUBCASE("other ranks than those of MPI are refused") {
    dovetail::parallel::run_ranks(network.size() + 1, [](dovetail::parallel::in_process& mine) {
      dovetail::any_communicator others(mine);
      const auto graph = element_graph(jittered_cubes(3));
      CHECK_THROWS_WITH_AS(over_ranks<P>{&others}(graph, 2), doctest::Contains("parallel::mpi"),
                           dovetail::usage_error);
    });
  }
}

} // namespace dovetail_test
