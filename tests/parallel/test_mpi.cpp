/// @file
/// Runs on all ranks of an mpirun.
#include "support/mpi_main.hpp"

#include "dovetail/parallel/mpi.hpp"
#include "dovetail/parallel/ranks.hpp"
#include "parallel/communicator_contract.hpp"
#include "parallel/executor_contract.hpp"

using namespace dovetail;
using dovetail::testing::world;

TEST_CASE("mpi is a communicator") {
  contract::check_communicator(*world);
}

TEST_CASE("Messages that are longer than a chunk arrive whole") {
  contract::check_communicator(parallel::mpi({}, 1000));
}

TEST_CASE("ranks is an executor over mpi") {
  contract::check_executor(parallel::ranks(*world), 1 << 22);
}

TEST_CASE("Another rank that abandons the run ends the waiting") {
  any_communicator& all = *world;
  if (all.size() == 1)
    return;
  const auto wait = [&] {
    all.agree(); // nobody is in the case before any more
    if (all.rank() == 1)
      all.abandon("no more");
    else
      all.await(all.next_tag());
  };
  if (all.rank() == 1)
    wait();
  else
    CHECK_THROWS_WITH_AS(wait(), "rank 1: no more", communication_error);
}
