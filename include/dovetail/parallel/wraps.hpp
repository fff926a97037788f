/// @file
/// An executor around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/concepts.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace dovetail {

namespace parallel {

/// Base of an executor that does something around the tasks of another one: workers, threads, ranks and what
/// is done once are those of `Executor`.
template <class Self, class Executor>
struct wraps : wrapped_policy<Self, Executor> {
  static_assert(executor<Executor>, "parallel::wraps holds an executor (parallel/concepts.hpp)");
  using wrapped_policy<Self, Executor>::wrapped_policy;
  using wrapped_policy<Self, Executor>::wrapped;

  /// Whether it says by its type that it runs tasks in threads.
  static constexpr bool uses_threads = dovetail::uses_threads<Executor>();

  /// The outcomes of the wrapped executor.
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    return wrapped.run(count, task, options);
  }
  /// How many tasks the wrapped executor runs at a time.
  int workers() const { return wrapped.workers(); }
  /// Whether its tasks run in this process.
  bool shares_process() const { return wrapped.shares_process(); }
  /// Between the ranks of the wrapped executor.
  any_communicator network() const requires detail::has_network<Executor> { return wrapped.network(); }
  /// What the wrapped executor keeps.
  auto results() const requires detail::has_results<Executor> { return wrapped.results(); }
  /// What one of its processes makes for all.
  byte_buffer once(const std::function<byte_buffer()>& work) const requires detail::does_once<Executor> {
    return wrapped.once(work);
  }
};

} // namespace parallel
} // namespace dovetail
