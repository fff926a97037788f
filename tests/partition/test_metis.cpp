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
