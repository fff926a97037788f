#include "dovetail/adapters/scotch.hpp"
#include "partition/partitioner_contract.hpp"

#include <cstdio>

using namespace dovetail;

TEST_CASE("Scotch satisfies the partitioner contract with every strategy") {
  for (const auto strategy : {partition::scotch_strategy::quality, partition::scotch_strategy::speed,
                              partition::scotch_strategy::balance}) {
    CAPTURE(static_cast<int>(strategy));
    dovetail_test::check_partitioner_contract(partition::scotch{.strategy = strategy}, 1.03);
  }
}

TEST_CASE("Scotch's result depends on the seed given, not on the calls before") {
  const csr_graph graph = dovetail_test::element_graph(dovetail_test::jittered_cubes(7), 1);
  const auto first = partition::scotch{}(graph, 6);
  const auto other = partition::scotch{.seed = 12345}(graph, 6);
  CHECK(partition::scotch{}(graph, 6) == first);
  CHECK(partition::scotch{.seed = 12345}(graph, 6) == other);
}
