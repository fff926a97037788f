/// @file
/// The executor that runs tasks in threads of this process.
#pragma once

#include "dovetail/parallel/available_processors.hpp"
#include "dovetail/parallel/concepts.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::parallel {

/// A model of `executor` for tasks that may run side by side in one process; TetGen and Gmsh may not. A task
/// that crashes ends the process, and one that hangs is not interrupted.
struct threads {
  /// Where types tell, a policy that may not run in threads does not compile with it.
  static constexpr bool uses_threads = true;

  int worker_count = 0; ///< 0: one per processor that this process may use

  int workers() const { return worker_count > 0 ? worker_count : available_processors(); }
  bool shares_process() const { return true; }

  /// Progress is reported from the calling thread; a stop takes effect when the running tasks have ended.
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options = {}) const;
};

static_assert(executor<threads>);

} // namespace dovetail::parallel

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/threads.ipp"
#endif
