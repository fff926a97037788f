#include "dovetail/improver/tetrahedra/effort.hpp"

#include <doctest/doctest.h>

using namespace dovetail;
using namespace dovetail::improvement;

namespace {

/// How many tries are allowed of which each k-th pays.
std::size_t tries(const effort_plan& plan, std::size_t elements, std::size_t k,
                  prospect kind = prospect::open) {
  effort credit(plan, elements);
  std::size_t count = 0;
  for (; credit.allows(kind) && count < 1'000'000; ++count)
    credit.record(kind, k > 0 && count % k == 0);
  return count;
}

} // namespace

TEST_CASE("without success the credit is a share of the elements, and at least so many tries") {
  const effort_plan plan{
      .open = {.share = 0.01, .least = 50, .reward = 8}, .most = 0.05, .least_of_most = 100};
  CHECK(tries(plan, 100'000, 0) == 1000);
  CHECK(tries(plan, 1000, 0) == 50);
}

TEST_CASE("while enough tries pay it goes on, up to a share of the elements") {
  const effort_plan plan{
      .open = {.share = 0.01, .least = 50, .reward = 8}, .most = 0.05, .least_of_most = 100};
  CHECK(tries(plan, 100'000, 1) == 5000);
  CHECK(tries(plan, 100'000, 8) == 5000);
  CHECK(tries(plan, 100'000, 16) < 2500);
  CHECK(tries(plan, 1000, 1) == 100);
}

TEST_CASE("tries of one kind are charged to that kind, and to all") {
  const effort_plan plan{.open = {.share = 0, .least = 10, .reward = 0},
                         .narrow = {.share = 0, .least = 3, .reward = 0},
                         .most = 0,
                         .least_of_most = 11};
  effort credit(plan, 1000);
  for (int i = 0; i < 3; ++i)
    credit.record(prospect::narrow, false);
  CHECK(!credit.allows(prospect::narrow));
  for (int i = 0; i < 7; ++i)
    credit.record(prospect::open, false);
  CHECK(credit.allows(prospect::open));
  credit.record(prospect::open, true);
  CHECK(!credit.allows(prospect::open));
}
