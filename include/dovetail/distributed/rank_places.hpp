/// @file
/// Where the ranks of a run are, and which of them work at a time. Linux.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/available_processors.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// Of one rank.
struct rank_place {
  std::string machine;                  ///< the same for ranks of one machine, whatever container they are in
  std::vector<std::int32_t> processors; ///< that it may use
  std::int32_t workers = 1;

  using fields = field_list<&rank_place::machine, &rank_place::processors, &rank_place::workers>;
};

/// That of the calling rank. Ranks that are threads of one process count as machines: they stand for such.
inline rank_place own_place(const any_communicator& network, int workers) {
  rank_place here;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> here.machine;
  if (network.shares_process())
    here.machine += " " + std::to_string(network.rank());
  here.processors = parallel::bound_processors();
  here.workers = static_cast<std::int32_t>(workers);
  return here;
}

/// Those of all ranks. Collective.
inline std::vector<rank_place> all_places(any_communicator network, int workers) {
  return network.all_gather(own_place(network, workers));
}

/// The ranks of one machine that work in a run of tasks: as many as it has processors for their workers, at
/// least one; others the next time. A rank takes no more processors than it is bound to. Workers that take
/// turns on a processor cost each other its caches: seven ranks on two processors meshed a third more slowly
/// than two.
inline std::vector<int> ranks_in_turn(const std::vector<int>& ranks, const std::vector<rank_place>& places,
                                      std::size_t turn) {
  std::vector<std::int32_t> processors;
  for (const int r : ranks)
    append(processors, places[r].processors);
  sort_unique(processors);
  auto free = static_cast<std::int64_t>(processors.size());
  std::vector<int> chosen;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const int r = ranks[(turn + i) % ranks.size()];
    const rank_place& place = places[r];
    free -= std::min<std::int64_t>(place.workers, std::ssize(place.processors));
    if (free < 0 && !chosen.empty())
      break;
    chosen.push_back(r);
  }
  return chosen;
}

/// The workers of each rank in a run of tasks, 0 of those that do not work: of all ranks where each machine
/// has a processor for each worker.
inline std::vector<std::int32_t> workers_at_work(const std::vector<rank_place>& places, std::size_t turn) {
  std::map<std::string, std::vector<int>> of_machine;
  for (std::size_t r = 0; r < places.size(); ++r)
    of_machine[places[r].machine].push_back(static_cast<int>(r));
  std::vector<std::int32_t> workers(places.size(), 0);
  for (const auto& [machine, ranks] : of_machine)
    for (const int r : ranks_in_turn(ranks, places, turn))
      workers[r] = places[r].workers;
  return workers;
}

} // namespace dovetail::detail
