/// @file
/// Runs on all ranks of an mpirun: elements to ranks by a partitioner whose result depends on their number.
#include "support/mpi_main.hpp"

#include "dovetail/adapters/ptscotch.hpp"
#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "lumps.hpp"
#include "redistributor_contract.hpp"

using namespace dovetail;
using namespace dovetail::testing;

TEST_CASE("by elements with PT-Scotch keeps the contract, and the report says what depends on the ranks") {
  const redistribution_by::elements how{.partitioner = {partition::ptscotch{}, "ptscotch"},
                                        .super_elements = 40,
                                        .run_tasks = parallel::ranks(*world)};
  for (const int ranks : {2, 5}) {
    const auto given = check_redistributor<3>(how, lumps(20 * ranks, 1, 0.5), ranks, 1.05);
    CHECK(given.summary.get("depends_on_ranks") == 1);
    REQUIRE(given.summary.warnings.size() == 1);
    CHECK(given.summary.warnings.front().starts_with("the partitioner 'ptscotch' gives other parts"));
    byte_writer mine;
    mine.array(given.rank_of_piece);
    for (const byte_buffer& theirs : world->all_gather(mine.take()))
      CHECK(byte_reader(theirs).array<local_id>() == given.rank_of_piece);
  }
}
