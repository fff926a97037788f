/// @file
/// A partitioner in two levels: a large graph is cut into groups, and each group into parts by a task.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/partition/apportion.hpp"
#include "dovetail/partition/checked_partition.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/node_groups.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace dovetail::partition {

/// Cuts a graph into groups by another partitioner, and, in tasks of an executor, each group into parts by
/// the same; in threads one after the other, since partitioners such as METIS draw the random numbers of
/// their process. A group gets parts by its weight. Graphs that are not large enough for two groups go to the
/// partitioner as they are, once.
///
/// The parts are the same for any executor; all its ranks have to ask for them. Of 1.06 million
/// super-elements in 1040 parts by `metis` the cut is as large as without groups (docs/partitioners.md).
template <graph_partitioner P>
struct in_groups {
  P partitioner{};                       ///< of the graph, and of each group
  any_executor run = parallel::serial{}; ///< runs a task per group
  double imbalance = 1.05;               ///< heaviest part over average part
  local_id nodes_per_group = 16'384;     ///< about so many
  int parts_per_group = 8;               ///< at least, on the average
  progress on_progress = {};             ///< told how the groups come along

  /// The part in [0, parts) of every node. Throws `partition_error` where the partitioner does, and
  /// `time_limit_error` when a task takes too long.
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    detail::require_imbalance(imbalance);
    const int groups = std::min(graph.node_count() / std::max(nodes_per_group, local_id{1}),
                                parts / std::max(parts_per_group, 1));
    if (groups < 2)
      return finished_once(graph, parts, [&] { return checked_partition(partitioner, graph, parts); });
    const std::vector<local_id> group =
        once(run, [&] { return checked_partition(partitioner, graph, groups); });
    const node_groups split(graph, group, groups);
    const std::vector<int> counts =
        apportion_parts(part_weights(graph, group, groups), split.counts(), parts);
    const auto made = parts_of_groups(split, counts);
    return finished_once(graph, parts, [&] { return split.joined(made, counts); });
  }

private:
  template <class Make>
  std::vector<local_id> finished_once(const csr_graph& graph, int parts, const Make& make) const {
    return once(run, [&] {
      std::vector<local_id> part = make();
      detail::finish_partition(graph, part, parts, imbalance, 0);
      return part;
    });
  }

  /// By the places of nodes in their group.
  std::vector<std::vector<local_id>> parts_of_groups(const node_groups& split,
                                                     const std::vector<int>& counts) const {
    auto results = map_tasks(
        runs_in_threads(run) ? any_executor(parallel::serial{}) : run, split.size(),
        [&](std::size_t g) { return checked_partition(partitioner, split.graph_of(g), counts[g]); },
        run_options{.on_progress = on_progress, .stage = "partition"});
    std::vector<std::vector<local_id>> made;
    for (std::size_t g = 0; g < results.size(); ++g) {
      const std::string who = "group " + std::to_string(g) + " of the graph: ";
      if (results[g].timed_out)
        throw time_limit_error(who + results[g].failure);
      if (!results[g].value)
        throw partition_error(who + results[g].failure);
      made.push_back(*std::move(results[g].value));
    }
    return made;
  }
};
template <class P, class... Rest>
in_groups(P, Rest...) -> in_groups<P>;

} // namespace dovetail::partition
