#include "rank_groups.hpp"

#include "neighbouring_relays.hpp"

#include "dovetail/parallel/available_processors.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>

#include <sched.h>

namespace dovetail::app {
namespace {

/// Those that a batch system or a container leaves this process, whatever it is bound to.
std::vector<std::int32_t> processors_it_could_have() {
  cpu_set_t bound, all;
  CPU_ZERO(&bound);
  if (::sched_getaffinity(0, sizeof bound, &bound) != 0)
    return parallel::bound_processors();
  CPU_ZERO(&all);
  for (int p = 0; p < CPU_SETSIZE; ++p)
    CPU_SET(p, &all);
  ::sched_setaffinity(0, sizeof all, &all);
  auto found = parallel::bound_processors();
  ::sched_setaffinity(0, sizeof bound, &bound);
  return found;
}

bool may_use(const rank_introduction& leader, const std::vector<std::int32_t>& processors) {
  return std::includes(leader.allowed.begin(), leader.allowed.end(), processors.begin(), processors.end());
}

std::vector<std::int32_t> joined(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b) {
  std::vector<std::int32_t> both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

} // namespace

rank_introduction introduction() {
  rank_introduction own;
  own.machine = place_of_numbers();
  own.processors = parallel::bound_processors();
  own.allowed = processors_it_could_have();
  return own;
}

std::vector<int> rank_groups::group_of(int rank) const {
  std::vector<int> group;
  for (std::size_t r = 0; r < leader_of_rank.size(); ++r)
    if (leader_of_rank[r] == leader_of_rank[static_cast<std::size_t>(rank)])
      group.push_back(static_cast<int>(r));
  return group;
}

std::vector<int> rank_groups::leaders() const {
  std::vector<int> found;
  for (std::size_t r = 0; r < leader_of_rank.size(); ++r)
    if (leader_of_rank[r] == static_cast<std::int32_t>(r))
      found.push_back(static_cast<int>(r));
  return found;
}

rank_groups groups_of(const std::vector<rank_introduction>& ranks, int at_most) {
  struct open_group {
    std::size_t leader;
    int members;
  };
  rank_groups groups;
  groups.processors.resize(ranks.size());
  std::map<std::string, open_group> open; // of each machine, the one that the next rank may join
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    const auto found = open.find(ranks[r].machine);
    const bool joins = found != open.end() && (at_most == 0 || found->second.members < at_most) &&
                       may_use(ranks[found->second.leader], ranks[r].processors);
    if (!joins)
      open[ranks[r].machine] = {r, 0};
    open_group& group = open[ranks[r].machine];
    ++group.members;
    groups.leader_of_rank.push_back(static_cast<std::int32_t>(group.leader));
    groups.processors[group.leader] = joined(groups.processors[group.leader], ranks[r].processors);
  }
  return groups;
}

} // namespace dovetail::app
