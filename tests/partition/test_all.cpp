#include "dovetail/partition/all.hpp"
#include "partition/partitioner_contract.hpp"

using namespace dovetail;

namespace {

/// Whether a partitioner wants to know where the nodes are.
template <graph_partitioner P>
bool goes_by_place(const P& partitioner) {
  csr_graph graph = dovetail_test::element_graph(dovetail_test::jittered_squares(4));
  graph.positions.clear();
  try {
    partitioner(graph, 2);
    return false;
  } catch (const partition_error& wanted) {
    CHECK_THROWS_WITH_AS(partitioner(graph, 2), doctest::Contains("positions"), partition_error);
    return true;
  }
}

} // namespace

TEST_CASE_TEMPLATE_DEFINE("every partitioner in the list satisfies the contract", P, keeps_contract) {
  const P partitioner{};
  dovetail_test::check_partitioner_contract(partitioner, 1.03, !goes_by_place(partitioner));
}
TEST_CASE_TEMPLATE_APPLY(keeps_contract, policy_types<decltype(partition::all())>);
