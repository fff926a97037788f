/// @file
/// One limit of wall-clock time for all tasks of a run, and the account of those that it has stopped.
#pragma once

#include "dovetail/parallel/any_executor.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail::parallel {

/// A model of `executor`: another one, under a limit of its own in place of that of `run_options`. Copies
/// share the account.
class clock_watch {
public:
  clock_watch(any_executor run, double limit_seconds)
      : run_(std::move(run)), limit_seconds_(limit_seconds), stops_(std::make_shared<int>(0)) {}

  std::vector<task_outcome> run(std::size_t count, const task_function& task, run_options options) const {
    options.limit_seconds = limit_seconds_;
    auto outcomes = run_.run(count, task, options);
    for (const task_outcome& outcome : outcomes)
      *stops_ += outcome.timed_out ? 1 : 0;
    return outcomes;
  }
  int workers() const { return run_.workers(); }
  bool shares_process() const { return run_.shares_process(); }
  any_communicator network() const { return run_.network(); }
  byte_buffer once(const std::function<byte_buffer()>& work) const { return run_.once(work); }

  /// Tasks that the limit has stopped so far, or one within them: what was done instead, the clock has
  /// decided.
  int stops() const { return *stops_; }

private:
  any_executor run_;
  double limit_seconds_;
  std::shared_ptr<int> stops_;
};
static_assert(executor<clock_watch>);

} // namespace dovetail::parallel
