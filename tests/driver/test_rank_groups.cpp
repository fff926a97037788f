#include "rank_groups.hpp"

#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/self.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sched.h>

namespace {

using namespace dovetail;
using namespace dovetail::app;
using numbers = std::vector<std::int32_t>;

static_assert(communicator<network_of_leaders<parallel::self>>);
static_assert(communicator<network_of_leaders<parallel::in_process>>);

rank_introduction on(const std::string& machine, numbers processors = {0}, numbers allowed = {0, 1, 2, 3}) {
  return {machine, std::move(processors), std::move(allowed)};
}

TEST_CASE("Ranks of a machine are a group, of at most so many") {
  const std::vector<rank_introduction> ranks{on("a"), on("b"), on("a"), on("a"), on("b")};
  CHECK(groups_of(ranks, 0).leader_of_rank == numbers{0, 1, 0, 0, 1});
  CHECK(groups_of(ranks, 1).leader_of_rank == numbers{0, 1, 2, 3, 4});
  const auto pairs = groups_of(ranks, 2);
  CHECK(pairs.leader_of_rank == numbers{0, 1, 0, 3, 1});
  CHECK(pairs.leaders() == std::vector<int>{0, 1, 3});
  CHECK(pairs.group_of(4) == std::vector<int>{1, 4});
  CHECK(pairs.group_of(3) == std::vector<int>{3});
}

TEST_CASE("A leader has the processors of its group, and no rank joins that has others") {
  const std::vector<rank_introduction> ranks{on("a", {1}), on("a", {0, 2}), on("a", {2}),
                                             on("a", {5}, {5, 6}), on("a", {6}, {5, 6})};
  const auto groups = groups_of(ranks, 0);
  CHECK(groups.leader_of_rank == numbers{0, 0, 0, 3, 3});
  CHECK(groups.processors == std::vector<numbers>{{0, 1, 2}, {}, {}, {5, 6}, {}});
}

TEST_CASE("A process tells what it is bound to and could be, and is bound as before") {
  cpu_set_t before, one;
  REQUIRE(::sched_getaffinity(0, sizeof before, &before) == 0);
  const rank_introduction own = introduction();
  CHECK_FALSE(own.machine.empty());
  CHECK_FALSE(own.processors.empty());
  CHECK(std::includes(own.allowed.begin(), own.allowed.end(), own.processors.begin(), own.processors.end()));
  CPU_ZERO(&one);
  CPU_SET(own.processors.back(), &one);
  REQUIRE(::sched_setaffinity(0, sizeof one, &one) == 0);
  const rank_introduction bound = introduction();
  CHECK(bound.processors == numbers{own.processors.back()});
  CHECK(bound.allowed == own.allowed);
  CHECK(introduction().processors == bound.processors);
  ::sched_setaffinity(0, sizeof before, &before);
}

TEST_CASE("Ranks meet, leaders speak to each other alone, and the others wait until theirs is done") {
  for (const int at_most : {1, 2, 3}) {
    std::vector<int> said(7, -1), leaders(7, -1);
    parallel::run_ranks(7, [&](parallel::in_process& mine) {
      const auto own = static_cast<std::size_t>(mine.rank());
      auto [groups, early] = meet(mine, on("a"), at_most, "dovetail mesh");
      CHECK(groups.command_line == "dovetail mesh");
      leaders[own] = groups.leader_of_rank[own];
      if (leaders[own] != mine.rank()) {
        said[own] = awaited(mine).peer;
        return;
      }
      any_communicator network(network_of_leaders(mine, groups, std::move(early)));
      const auto all = network.all_gather(mine.rank());
      CHECK(all == groups.leaders());
      CHECK(all[static_cast<std::size_t>(network.rank())] == mine.rank());
      for (const int member : groups.group_of(mine.rank()))
        if (member != mine.rank())
          mine.send(member, group_tags::over, {});
    });
    for (std::size_t r = 0; r < 7; ++r) {
      CHECK(leaders[r] == static_cast<int>(r) / at_most * at_most);
      CHECK(said[r] == (r % static_cast<std::size_t>(at_most) == 0 ? -1 : leaders[r]));
    }
  }
}

/// Gives messages that others have sent, one after the other.
struct letter_box {
  std::deque<rank_message> letters;
  int rank() const { return 2; }
  int size() const { return 3; }
  void send(int, std::int32_t, const byte_buffer&) {}
  std::optional<rank_message> receive() {
    if (letters.empty())
      return {};
    auto next = std::move(letters.front());
    letters.pop_front();
    return next;
  }
  void wait(std::chrono::milliseconds) {}
  int descriptor() const { return -1; }
  bool shares_process() const { return false; }
  void abandon(const std::string&) {}
};

TEST_CASE("What another leader says before this one knows the groups is not lost") {
  rank_groups groups{{0, 1, 2}, {{}, {}, {}}, "dovetail"};
  letter_box box;
  box.letters.push_back({1, 7, encoded(5)});
  box.letters.push_back({0, group_tags::groups, encoded(groups)});
  box.letters.push_back({1, 8, encoded(6)});
  auto [met, early] = meet(box, on("a"), 1, "dovetail");
  network_of_leaders network(box, met, std::move(early));
  for (const int expected : {5, 6}) {
    const auto next = network.receive();
    REQUIRE(next.has_value());
    CHECK(next->peer == 1);
    CHECK(decoded<int>(next->bytes) == expected);
  }
  CHECK_FALSE(network.receive().has_value());
}

TEST_CASE("A rank with another command line than rank 0 is refused") {
  letter_box box;
  box.letters.push_back({0, group_tags::groups, encoded(rank_groups{{0, 1, 2}, {{}, {}, {}}, "dovetail"})});
  CHECK_THROWS_WITH_AS(meet(box, on("a"), 1, "dovetail mesh"),
                       "this rank starts from 'dovetail mesh', and rank 0 from 'dovetail'", usage_error);
}

} // namespace
