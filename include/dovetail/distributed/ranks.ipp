/// @file
/// What `ranks.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/distributed/process_pool.hpp"
#include "dovetail/distributed/rank_tasks.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The tasks of one rank, one after another in this process; by place, those of other ranks empty.
inline std::vector<task_outcome> run_here(std::size_t count, const task_function& task,
                                          const run_options& options, task_feed& feed,
                                          any_communicator network) {
  const auto order = start_order(count, options);
  std::vector<task_outcome> outcomes(count);
  std::vector<std::size_t> left; // the next one is last
  while (!left.empty() || !feed.ended()) {
    const auto more = feed.granted();
    left.insert(left.begin(), more.rbegin(), more.rend());
    options.on_progress(options.stage, feed.done(), count);
    if (left.empty()) {
      if (!feed.ended())
        network.wait(std::chrono::milliseconds(100));
      continue;
    }
    const std::size_t place = left.back();
    left.pop_back();
    outcomes[order[place]] = run_task(task, order[place]);
    feed.finished(place);
  }
  return outcomes;
}

} // namespace dovetail::detail

namespace dovetail::parallel {

DOVETAIL_INLINE ranks::ranks(any_communicator network, int worker_count)
    : network_(std::move(network)), worker_count_(worker_count) {
  if (worker_count > 0 && network_.shares_process() && network_.size() > 1)
    throw usage_error("ranks that are threads of one process cannot fork workers");
  places_ = detail::all_places(network_, std::max(1, worker_count));
  for (const detail::rank_place& place : places_)
    workers_ += place.workers;
}

DOVETAIL_INLINE std::vector<task_outcome> ranks::run(std::size_t count, const task_function& task,
                                                     const run_options& options) const {
  if (worker_count_ > 0)
    detail::require_single_thread();
  if (count == 0)
    return {};
  options.on_progress(options.stage, 0, count);
  detail::rank_tasks feed(network_, count, detail::workers_at_work(places_, (*runs_)++));
  auto mine =
      worker_count_ > 0
          ? detail::process_pool(count, task, options, static_cast<std::size_t>(worker_count_), &feed).run()
          : detail::run_here(count, task, options, feed, network_);
  const auto order = detail::start_order(count, options);
  std::vector<std::pair<std::size_t, task_outcome>> done; // with the numbers of the tasks
  for (const std::size_t place : feed.finished_places())
    done.emplace_back(order[place], std::move(mine[order[place]]));
  auto network = network_;
  for (auto& theirs : network.all_gather(done))
    for (auto& [number, outcome] : theirs)
      mine.at(number) = std::move(outcome);
  options.on_progress(options.stage, count, count);
  return mine;
}

} // namespace dovetail::parallel
