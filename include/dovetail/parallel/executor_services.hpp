/// @file
/// What stages ask of any executor: its tasks with their results checked, its ranks, and what it keeps.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/core/policy.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/self.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace dovetail {

namespace detail {

/// Runs tasks as an executor does.
using task_runner =
    std::function<std::vector<task_outcome>(std::size_t, const task_function&, const run_options&)>;

/// What such a function gives. Throws `usage_error` that names the executor when that is other than one
/// outcome per task, or a result of another task, and for what it throws that is no error of ours.
std::vector<task_outcome> checked_outcomes(const task_runner& run, const std::string& name, std::size_t count,
                                           const task_function& task, const run_options& options);

template <class Executor>
inline constexpr bool checks_outcomes = requires {
  requires Executor::checks_outcomes;
};

} // namespace detail

/// The ranks that go through the same program; `self` where there is one process.
/// \param run an executor
template <executor Executor>
any_communicator network_of(const Executor& run) {
  if constexpr (detail::has_network<Executor>)
    return run.network();
  else
    return parallel::self{};
}

/// Whether other processes go through the same program, so that what is made `once` has to be bytes.
/// \param run an executor
template <executor Executor>
bool has_others(const Executor& run) {
  if constexpr (detail::has_network<Executor>)
    return run.network().size() > 1;
  else
    return false;
}

/// Whether what is not a task, files for example, is this process's to do: not on all ranks of `ranks`.
/// \param run an executor
template <executor Executor>
bool leads(const Executor& run) {
  if constexpr (detail::has_network<Executor>)
    return run.network().leads();
  else
    return true;
}

/// Where an executor keeps what stages have made; null where it keeps nothing (see `remembering`).
/// \param run an executor
template <executor Executor>
std::shared_ptr<run_results> results_of(const Executor& run) {
  if constexpr (detail::has_results<Executor>)
    return run.results();
  else
    return nullptr;
}

namespace detail {

template <executor Executor>
byte_buffer bytes_once(const Executor& run, const std::function<byte_buffer()>& work) {
  if constexpr (does_once<Executor>)
    return run.once(work);
  else
    return network_of(run).once(work);
}

} // namespace detail

/// What `work()` returns, made by the process that leads alone; an error of it is thrown by all. A value is
/// sent to the others (`encodable`).
/// \param run an executor
/// \param work returns a value, or nothing
template <executor Executor, class Work>
auto once(const Executor& run, const Work& work) {
  using value = decltype(work());
  if constexpr (std::is_void_v<value>) {
    if (!has_others(run))
      work();
    else
      detail::bytes_once(run, [&] { return work(), byte_buffer{}; });
  } else {
    return has_others(run) ? decoded<value>(detail::bytes_once(run, [&] { return encoded<value>(work()); }))
                           : work();
  }
}

/// The outcomes of tasks, one each, in order. Throws `usage_error` that names the executor when it gives
/// others, or throws what is no error of ours. One that sees to this itself says so by its type, `static
/// constexpr bool checks_outcomes = true`.
/// \param run an executor
/// \param count how many tasks there are
/// \param task gives the bytes of a task's result
/// \param options names, limits and the order of tasks
template <executor Executor>
std::vector<task_outcome> run_checked(const Executor& run, std::size_t count, const task_function& task,
                                      const run_options& options) {
  if constexpr (detail::checks_outcomes<Executor>)
    return run.run(count, task, options);
  else
    return detail::checked_outcomes([&run](std::size_t tasks, const task_function& marked,
                                           const run_options& how) { return run.run(tasks, marked, how); },
                                    policy_name(run), count, task, options);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/executor_services.ipp"
#endif
