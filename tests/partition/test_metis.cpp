#include "dovetail/partition/metis.hpp"
#include "partition/partitioner_contract.hpp"

using namespace dovetail;

TEST_CASE("METIS, k-way, satisfies the partitioner contract") {
  dovetail_test::check_partitioner_contract(partition::metis{}, 1.03);
}

TEST_CASE("METIS, recursive, satisfies the partitioner contract") {
  dovetail_test::check_partitioner_contract(partition::metis{.recursive = true}, 1.03);
}
