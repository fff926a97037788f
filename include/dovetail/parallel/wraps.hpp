/// @file
/// An executor around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/concepts.hpp"

#include <concepts>
#include <cstddef>
#include <functional>
#include <vector>

namespace dovetail {

namespace detail {

template <class Executor>
inline constexpr bool has_network = requires(const Executor& run) {
  run.network();
};
template <class Executor>
inline constexpr bool does_once = requires(const Executor& run, const std::function<byte_buffer()>& work) {
  { run.once(work) } -> std::same_as<byte_buffer>;
};

} // namespace detail

namespace parallel {

/// Base of an executor that does something around the tasks of another one: workers, ranks and what is done
/// once are those of `Executor`.
template <class Self, executor Executor>
struct wraps : wrapped_policy<Self, Executor> {
  using wrapped_policy<Self, Executor>::wrapped_policy;
  using wrapped_policy<Self, Executor>::wrapped;

  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    return wrapped.run(count, task, options);
  }
  int workers() const { return wrapped.workers(); }
  bool shares_process() const { return wrapped.shares_process(); }
  any_communicator network() const requires detail::has_network<Executor> { return wrapped.network(); }
  byte_buffer once(const std::function<byte_buffer()>& work) const requires detail::does_once<Executor> {
    return wrapped.once(work);
  }
};

} // namespace parallel
} // namespace dovetail
