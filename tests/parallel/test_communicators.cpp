#include "dovetail/distributed/relay.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/parallel/error_codec.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/self.hpp"
#include "parallel/communicator_contract.hpp"

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

using namespace dovetail;

namespace {

/// Runs `work` on a rank whose network is spoken to by another thread.
void with_relay(parallel::in_process& network, const std::function<void(any_communicator)>& work) {
  std::array<int, 2> ends{};
  REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0);
  std::atomic<bool> done = false;
  std::thread speaker([&] {
    parallel::relay relay(network, ends[0]);
    try {
      while (!done)
        if (!relay.step())
          std::this_thread::sleep_for(std::chrono::microseconds(100));
    } catch (const communication_error& problem) {
      relay.tell_abandoned(problem.what());
    }
    while (!done)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  std::exception_ptr failure;
  try {
    work(parallel::relayed(ends[1]));
    network.wait(std::chrono::milliseconds(0));
  } catch (...) {
    failure = std::current_exception();
  }
  done = true;
  speaker.join();
  ::close(ends[0]);
  ::close(ends[1]);
  if (failure)
    std::rethrow_exception(failure);
}

} // namespace

TEST_CASE("self is a communicator") {
  contract::check_communicator(parallel::self{});
  CHECK_THROWS_AS(parallel::self{}.send(1, 0, {}), usage_error);
}

TEST_CASE("in_process is a communicator, whatever the number of ranks") {
  for (const int ranks : {1, 2, 3, 4, 7}) {
    CAPTURE(ranks);
    parallel::run_ranks(ranks, [](parallel::in_process& mine) { contract::check_communicator(mine); });
  }
  CHECK_THROWS_AS(parallel::run_ranks(0, [](parallel::in_process&) {}), usage_error);
}

TEST_CASE("A rank that fails ends the others, and its own error is thrown") {
  for (int failing = 0; failing < 3; ++failing) {
    std::atomic<int> ended = 0;
    const auto work = [&](parallel::in_process& mine) {
      any_communicator all(std::move(mine)); // it is the rank's to give away
      if (all.rank() == failing)
        throw geometry_error("no solid");
      try {
        all.agree();
      } catch (const communication_error& problem) {
        CHECK(problem.what() == "rank " + std::to_string(failing) + ": no solid");
        ++ended;
        throw;
      }
    };
    CHECK_THROWS_WITH_AS(parallel::run_ranks(3, work), "no solid", geometry_error);
    CHECK(ended == 2);
  }
}

TEST_CASE("relayed is a communicator") {
  for (const int ranks : {1, 2, 4}) {
    CAPTURE(ranks);
    std::atomic<int> left = ranks;
    parallel::run_ranks(ranks, [&](parallel::in_process& mine) {
      with_relay(mine, [&](any_communicator all) {
        contract::check_communicator(all);
        for (--left; left > 0;) // or what others still need of this relay would be lost
          all.wait(std::chrono::milliseconds(1));
      });
    });
  }
}

TEST_CASE("A relay that is gone, and a rank that abandons the run behind one, end the waiting") {
  std::array<int, 2> ends{};
  REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0);
  ::close(ends[0]);
  CHECK_THROWS_AS(parallel::relayed{ends[1]}, communication_error);
  ::close(ends[1]);

  std::atomic<int> told = 0;
  parallel::run_ranks(2, [&](parallel::in_process& mine) {
    try {
      with_relay(mine, [&](any_communicator all) {
        if (all.rank() == 1)
          all.abandon("enough");
        all.await(all.next_tag());
      });
    } catch (const communication_error& problem) {
      CHECK(std::string(problem.what()) == "rank 1: enough");
      ++told;
    }
  });
  CHECK(told == 2);
}

TEST_CASE("Errors keep their types on their way, also what is none of the library's") {
  const auto passed = [](auto problem) { throw_error(encode_error(std::make_exception_ptr(problem))); };
  CHECK_THROWS_WITH_AS(passed(input_error("a")), "a", input_error);
  CHECK_THROWS_WITH_AS(passed(geometry_error("b")), "b", geometry_error);
  CHECK_THROWS_WITH_AS(passed(sizing_error("c")), "c", sizing_error);
  CHECK_THROWS_WITH_AS(passed(intersection_error("d")), "d", intersection_error);
  CHECK_THROWS_WITH_AS(passed(partition_error("e")), "e", partition_error);
  CHECK_THROWS_WITH_AS(passed(time_limit_error("f")), "f", time_limit_error);
  CHECK_THROWS_WITH_AS(passed(mesher_error("g")), "g", mesher_error);
  CHECK_THROWS_WITH_AS(passed(mesh_error("h")), "h", mesh_error);
  CHECK_THROWS_WITH_AS(passed(io_error("i")), "i", io_error);
  CHECK_THROWS_WITH_AS(passed(usage_error("j")), "j", usage_error);
  CHECK_THROWS_WITH_AS(passed(std::runtime_error("k")), "k", error);
  CHECK_THROWS_AS(passed(5), error);
  try {
    passed(error_of_faces<intersection_error>("l", {3, 5}));
  } catch (const intersection_error& problem) {
    CHECK(problem.what() == std::string("l"));
    const auto* blamed = dynamic_cast<const blames_faces*>(&problem);
    REQUIRE(blamed);
    CHECK(blamed->faces() == std::vector<local_id>{3, 5});
  }
  CHECK_THROWS_AS(passed(cancelled()), cancelled);
  CHECK_THROWS_AS(passed(std::bad_alloc()), std::bad_alloc);
}
