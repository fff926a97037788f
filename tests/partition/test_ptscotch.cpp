/// @file
/// Runs on all ranks of an mpirun.
#include "support/mpi_main.hpp"

#include "dovetail/adapters/ptscotch.hpp"
#include "partition/distributed_contract.hpp"

TEST_CASE("PT-Scotch satisfies the partitioner contract on graphs that are spread over ranks") {
  dovetail_test::check_distributed_partitioner<dovetail::partition::ptscotch>(*dovetail::testing::world);
}

TEST_CASE("ranks without nodes are no matter") {
  using namespace dovetail;
  any_communicator& network = *testing::world;
  const csr_graph graph = dovetail_test::element_graph(dovetail_test::jittered_cubes(6), 1);
  distributed_csr_graph all_on_last = rows_of_rank(graph, 0, 1);
  all_on_last.rank = network.rank();
  all_on_last.first_of_rank.assign(static_cast<std::size_t>(network.size()), 0);
  all_on_last.first_of_rank.push_back(graph.node_count());
  if (network.rank() + 1 < network.size())
    all_on_last.rows = {};
  byte_writer mine;
  mine.array(partition::ptscotch{}(network, all_on_last, 5));
  std::vector<local_id> part;
  for (const byte_buffer& theirs : network.all_gather(mine.take()))
    append(part, byte_reader(theirs).array<local_id>());
  dovetail_test::check_partition(graph, part, 5, 1.03);
}
