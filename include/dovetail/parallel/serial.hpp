/// @file
/// The executor that does one task after the other, here.
#pragma once

#include "dovetail/parallel/run_task.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::parallel {

/// A model of `executor`; the library's default. A task that crashes ends the process, and one that hangs is
/// not interrupted: `run_options::limit_seconds` is not enforced.
struct serial {
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options = {}) const {
    const auto order = detail::start_order(count, options);
    std::vector<task_outcome> outcomes(count);
    options.on_progress(options.stage, 0, count);
    for (std::size_t done = 0; done < count;) {
      outcomes[order[done]] = detail::run_task(task, order[done]);
      options.on_progress(options.stage, ++done, count);
    }
    return outcomes;
  }
  int workers() const { return 1; }
  bool shares_process() const { return true; }
};

static_assert(executor<serial>);

} // namespace dovetail::parallel
