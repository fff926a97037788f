/// @file
/// One limit of wall-clock time for all tasks of a run, and the account of those that it has stopped.
#pragma once

#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/wraps.hpp"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail::parallel {

/// A model of `executor`: another one, under a limit of its own in place of that of `run_options`. Copies
/// share the account.
class clock_watch : public wraps<clock_watch, any_executor> {
public:
  clock_watch(any_executor run, double limit_seconds)
      : wraps(std::move(run)), limit_seconds_(limit_seconds), stops_(std::make_shared<int>(0)) {}

  std::vector<task_outcome> run(std::size_t count, const task_function& task, run_options options) const {
    options.limit_seconds = limit_seconds_;
    auto outcomes = wrapped.run(count, task, options);
    for (const task_outcome& outcome : outcomes)
      *stops_ += outcome.timed_out ? 1 : 0;
    return outcomes;
  }

  /// Tasks that this limit, or one within them, has stopped so far; what replaced them depends on the clock.
  int stops() const { return *stops_; }

private:
  double limit_seconds_;
  std::shared_ptr<int> stops_;
};
static_assert(executor<clock_watch>);

} // namespace dovetail::parallel
