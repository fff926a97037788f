/// @file
/// What `processes.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/distributed/process_pool.hpp"
#include "dovetail/distributed/processes.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::parallel {

DOVETAIL_INLINE std::vector<task_outcome> processes::run(std::size_t count, const task_function& task,
                                                         const run_options& options) const {
  detail::require_single_thread();
  if (count == 0)
    return {};
  return detail::process_pool(count, task, options, static_cast<std::size_t>(workers())).run();
}

} // namespace dovetail::parallel
