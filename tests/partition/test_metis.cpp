#include "dovetail/adapters/metis.hpp"
#include "partition/partitioner_contract.hpp"

#include <csignal>
#include <sys/time.h>

using namespace dovetail;

TEST_CASE("METIS, k-way, satisfies the partitioner contract") {
  dovetail_test::check_partitioner_contract(partition::metis{}, 1.03);
}

TEST_CASE("METIS, recursive, satisfies the partitioner contract") {
  dovetail_test::check_partitioner_contract(partition::metis{.recursive = true}, 1.03);
}

TEST_CASE("METIS tries four partitions of small graphs into few parts and one of others") {
  const auto trials_that_serve = [](int cubes, int least_parts) {
    const csr_graph graph = dovetail_test::element_graph(dovetail_test::jittered_cubes(cubes));
    bool differ = false; // one and four need not give different partitions each time
    std::vector<int> found{1, 4};
    for (int parts = least_parts; parts < least_parts + 6; ++parts) {
      const auto given = partition::metis{}(graph, parts);
      const auto by_one = partition::metis{.trials = 1}(graph, parts);
      const auto by_four = partition::metis{.trials = 4}(graph, parts);
      differ = differ || by_one != by_four;
      std::erase_if(found, [&](int trials) { return given != (trials == 1 ? by_one : by_four); });
    }
    CHECK(differ);
    return found;
  };
  CHECK(trials_that_serve(12, 10) == std::vector{4}); // 10,368 nodes
  CHECK(trials_that_serve(12, 59) == std::vector{4}); // up to 64 parts
  CHECK(trials_that_serve(12, 65) == std::vector{1});
  CHECK(trials_that_serve(26, 10) == std::vector{1}); // 105,456 nodes
}

namespace {

volatile std::sig_atomic_t stops = 0;

} // namespace

TEST_CASE("a request to stop while METIS runs is neither lost nor an error of METIS") {
  const csr_graph cubes = dovetail_test::element_graph(dovetail_test::jittered_cubes(30));
  const auto old_stop = std::signal(SIGTERM, [](int) { stops = stops + 1; });
  const auto old_alarm = std::signal(SIGALRM, [](int) { std::raise(SIGTERM); });
  const itimerval soon{{0, 20000}, {0, 20000}};
  const itimerval never{};
  ::setitimer(ITIMER_REAL, &soon, nullptr);
  const auto part = partition::metis{}(cubes, 50);
  ::setitimer(ITIMER_REAL, &never, nullptr);
  const int before = stops;
  std::raise(SIGTERM);
  std::raise(SIGTERM); // METIS would leave a handler good for one
  CHECK(stops == before + 2);
  std::signal(SIGTERM, old_stop);
  std::signal(SIGALRM, old_alarm);
  CHECK(stops > 0);
  CHECK(part == partition::metis{}(cubes, 50));
}
