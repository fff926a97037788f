/// @file
/// The executor that runs tasks in forked worker processes: a crash, leak or hang costs one task. Linux.
#pragma once

#include "dovetail/distributed/worker_process.hpp"
#include "dovetail/parallel/available_processors.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::parallel {

/// A model of `executor`. Workers are forked for each call of `run`, so tasks see all data as they are then,
/// without copying; they end with the call, and with this process if it dies. Their standard streams are
/// silent. Each takes its next task by itself, as soon as it has sent the result of the last. A worker whose
/// task failed is replaced, so that nothing of the failure reaches other tasks. A task whose worker is killed
/// by SIGKILL, which is none of its doing, is run once more. Refuses with `usage_error` in a process that has
/// other threads: forking copies locks but not their holders.
struct processes {
  int worker_count = 0; ///< 0: one per processor that this process may use

  int workers() const { return worker_count > 0 ? worker_count : available_processors(); }
  bool shares_process() const { return false; }

  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options = {}) const;
};

} // namespace dovetail::parallel

namespace dovetail::parallel {

static_assert(executor<processes>);

} // namespace dovetail::parallel

#ifndef DOVETAIL_COMPILED
#include "dovetail/distributed/processes.ipp"
#endif
