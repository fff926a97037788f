/// @file
/// What all executors share: one task run in this process, and the order in which tasks are started.
#pragma once

#include "dovetail/parallel/concepts.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dovetail {

namespace detail {

/// Runs one task here; its exception becomes a failed outcome.
task_outcome run_task(const task_function& task, std::size_t index);

/// Throws what has become of a child process in which a policy runs a library: `time_limit_error` or
/// `mesher_error`, naming the policy.
void require_done(const task_outcome& outcome, const std::string& policy);

/// `options.order`, or 0, 1, 2, ...; throws `usage_error` when it is not a permutation of the tasks.
std::vector<std::size_t> start_order(std::size_t count, const run_options& options);

} // namespace detail
} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/run_task.ipp"
#endif
