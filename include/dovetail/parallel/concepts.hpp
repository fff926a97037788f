/// @file
/// What the pipeline asks of an executor, and what becomes of a task.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/ids.hpp"
#include "dovetail/core/progress.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dovetail {

class run_results; // parallel/run_results.hpp

/// What became of one task.
struct task_outcome {
  bool ok = false;        ///< whether it gave a result
  byte_buffer result;     ///< what the task returned, when ok
  std::string failure;    ///< why it failed, when not ok: the exception's text, a signal, a time limit
  bool crashed = false;   ///< the worker died (signal or exit) rather than throwing
  bool timed_out = false; ///< a wall-clock limit, the last resort, was reached: the task's, or within it
  double seconds = 0;     ///< the task's own wall time
  std::uint64_t peak_rss_bytes = 0; ///< of the worker that ran it, when known

  using fields =
      field_list<&task_outcome::ok, &task_outcome::result, &task_outcome::failure, &task_outcome::crashed,
                 &task_outcome::timed_out, &task_outcome::seconds, &task_outcome::peak_rss_bytes>;
};

/// How a batch of tasks is run.
struct run_options {
  std::vector<std::size_t> order = {}; ///< a permutation of the tasks, or empty for 0, 1, 2, ...
  double limit_seconds = 600;          ///< wall-clock limit of one task; the last resort
  progress on_progress = {};           ///< told how the tasks come along
  std::string stage = "tasks";         ///< the name progress is reported under
};

/// A task by its number; gives the bytes of its result.
using task_function = std::function<byte_buffer(std::size_t)>;

/// The role `executor`: run independent tasks and collect their encoded results.
///
/// Valid expressions for `const E& e`:
///
/// - `e.run(count, task, options)`: std::vector<task_outcome> of length count, outcome i being that of
/// `task(i)`
/// - `e.workers()`: how many tasks run at a time, an int
/// - `e.shares_process()`: whether tasks run in this process, and not in children or on other machines
///
/// Semantics: `task(i)` depends only on i and data fixed before the call, and gives back its return value
/// only: it may run in another thread or process. A task that throws, crashes or exceeds the limit gives an
/// outcome with `ok == false` and the reason; the others go on. Outcomes are the same for every model and
/// number of workers. `options.order` lists tasks in the order they are started (largest predicted cost
/// first). Where tasks share the process, a task that crashes ends it and, with more than one worker, what
/// tasks call must be thread-safe (`runs_in_threads`).
///
/// Complexity: the tasks' own, plus one copy of each result.
///
/// Failure: throws `usage_error` when it may not run here, `cancelled` when the caller asks to stop.
///
/// An executor whose tasks are shared by several ranks of the same program has also `e.network()`, their
/// any_communicator; see `ranks`. A wrapper may have `e.once(work)` in place of the network's. One that keeps
/// what was made has `e.results()`; see `remembering`. Stages ask for these, of any executor, by functions
/// (parallel/executor_services.hpp).
///
/// Models: serial, threads, processes, ranks, clock_watch, remembering, forgetting,
/// traced, any_executor.
template <class E>
concept executor = std::copy_constructible<E> &&
    requires(const E& e, std::size_t count, const task_function& task, const run_options& options) {
  { e.run(count, task, options) } -> std::same_as<std::vector<task_outcome>>;
  { e.workers() } -> std::convertible_to<int>;
  { e.shares_process() } -> std::convertible_to<bool>;
};

namespace detail {

template <class Executor>
inline constexpr bool has_network = requires(const Executor& run) {
  run.network();
};
template <class Executor>
inline constexpr bool has_results = requires(const Executor& run) {
  { run.results() } -> std::convertible_to<std::shared_ptr<run_results>>;
};
template <class Executor>
inline constexpr bool does_once = requires(const Executor& run, const std::function<byte_buffer()>& work) {
  { run.once(work) } -> std::same_as<byte_buffer>;
};

} // namespace detail

/// Whether an executor runs tasks side by side in threads of one process: what a task calls must then be
/// thread-safe.
/// \param e an executor
template <executor E>
bool runs_in_threads(const E& e) {
  return e.shares_process() && e.workers() > 1;
}

/// Whether an executor says by its type, `static constexpr bool uses_threads = true`, that it is there to run
/// tasks in threads; of others that is known when the program runs.
template <executor E>
constexpr bool uses_threads() {
  if constexpr (requires { E::uses_threads; })
    return E::uses_threads;
  else
    return false;
}

} // namespace dovetail
