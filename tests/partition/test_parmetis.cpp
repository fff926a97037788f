/// @file
/// Runs on all ranks of an mpirun.
#include "support/mpi_main.hpp"

#include "dovetail/adapters/parmetis.hpp"
#include "partition/distributed_contract.hpp"

#include <cstdlib>

using dovetail::partition::parmetis;

TEST_CASE("ParMETIS's interface satisfies the partitioner contract on graphs that are spread over ranks") {
  ::setenv("SCOTCH_PTHREAD_NUMBER", "1", 1);
  dovetail_test::check_distributed_partitioner<parmetis>(*dovetail::testing::world);
}

#ifdef SCOTCH_PARMETIS_VERSION
TEST_CASE("PT-Scotch's ParMETIS is refused with threads, whose result differs from call to call") {
  ::setenv("SCOTCH_PTHREAD_NUMBER", "2", 1);
  const dovetail_test::over_ranks<parmetis> spread{dovetail::testing::world};
  CHECK_THROWS_WITH_AS(spread(dovetail_test::element_graph(dovetail_test::jittered_cubes(3)), 2),
                       doctest::Contains("SCOTCH_PTHREAD_NUMBER=1"), dovetail::usage_error);
}
#endif
