/// @file
/// Runs on all ranks of an mpirun.
#include "support/mpi_main.hpp"

#include "dovetail/distributed/mpi.hpp"
#include "dovetail/distributed/ranks.hpp"
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

TEST_CASE("A rank that abandons the run, whichever it is, ends the waiting of all others") {
  for (int quits = 0; quits < world->size() && world->size() > 1; ++quits) {
    CAPTURE(quits);
    any_communicator all =
        parallel::mpi(boost::mpi::communicator(MPI_COMM_WORLD, boost::mpi::comm_duplicate));
    if (all.rank() == quits)
      all.abandon("no more");
    else
      CHECK_THROWS_WITH_AS(all.await(all.next_tag()), ("rank " + std::to_string(quits) + ": no more").c_str(),
                           communication_error);
  }
}
