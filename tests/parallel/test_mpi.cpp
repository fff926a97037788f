/// @file
/// Runs on all ranks of an mpirun.
#include "support/mpi_main.hpp"

#include "dovetail/distributed/mpi.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "parallel/communicator_contract.hpp"
#include "parallel/executor_contract.hpp"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <unistd.h>

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

TEST_CASE("A rank that abandons the run waits for nothing that others have not taken before") {
  if (world->size() == 1)
    return;
  constexpr auto for_ever = std::chrono::hours(1);
  std::optional<parallel::mpi> network(std::in_place, boost::mpi::communicator(), std::size_t{1} << 28,
                                       for_ever);
  if (network->rank() == 0) {
    network->send(1, 1,
                  byte_buffer(std::size_t{1} << 25)); // too long to be on its way before it is asked for
    network->abandon("no more");
    network.reset();
  }
  world->agree(); // which rank 1 does before it looks for messages
}

TEST_CASE("A farewell is heard before a long message that does not come") {
  if (world->size() == 1)
    return;
  // What the two do meanwhile is not to be seen by MPI, which would move the message.
  const std::filesystem::path heard =
      std::filesystem::temp_directory_path() / ("dovetail_heard_" + std::to_string(::getppid()));
  std::filesystem::remove(heard);
  world->agree();
  parallel::mpi network;
  if (network.rank() == 0) {
    network.send(1, 1, byte_buffer(std::size_t{1} << 25));
    network.abandon("no more");
    while (!std::filesystem::exists(heard))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::filesystem::remove(heard);
  } else if (network.rank() == 1) {
    const auto hear = [&] {
      for (;; network.wait(std::chrono::milliseconds(1)))
        network.receive(); // an MPI that copies from the other's memory may bring the message all the same
    };
    CHECK_THROWS_WITH_AS(hear(), "rank 0: no more", communication_error);
    std::ofstream(heard).put('1');
  }
  world->agree();
}
