/// @file
/// What `serial.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/run_task.hpp"
#include "dovetail/parallel/serial.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::parallel {

DOVETAIL_INLINE std::vector<task_outcome> serial::run(std::size_t count, const task_function& task,
                                                      const run_options& options) const {
  const auto order = detail::start_order(count, options);
  std::vector<task_outcome> outcomes(count);
  options.on_progress(options.stage, 0, count);
  for (std::size_t done = 0; done < count;) {
    outcomes[order[done]] = detail::run_task(task, order[done]);
    options.on_progress(options.stage, ++done, count);
  }
  return outcomes;
}

} // namespace dovetail::parallel
