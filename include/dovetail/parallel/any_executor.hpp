/// @file
/// Any executor behind one type, so that the stages are compiled once and not once per executor.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/executor_services.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Holds any executor by value; an executor converts to it. A run costs one indirect call. Throws
/// `usage_error` that names the executor when it gives other than one outcome per task, or throws what is no
/// error of ours.
class any_executor {
public:
  template <class E>
    requires(!std::same_as<E, any_executor> && executor<E>)
  any_executor(E policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)), workers_(static_cast<int>(policy.workers())),
        shares_process_(policy.shares_process()), network_(network_of(policy)), results_(results_of(policy)) {
    if constexpr (detail::does_once<E>)
      once_ = [held = policy](const std::function<byte_buffer()>& work) { return held.once(work); };
    else
      once_ = [held = network_](const auto& work) mutable { return held.once(work); };
    run_ = [held = std::move(policy)](std::size_t count, const task_function& task,
                                      const run_options& options) { return held.run(count, task, options); };
  }

  static constexpr bool checks_outcomes = true; ///< `run_checked` need not

  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  int workers() const { return workers_; }
  bool shares_process() const { return shares_process_; }
  /// Of the ranks that go through the same program; `self` where there is one process.
  any_communicator network() const { return network_; }
  /// Where it keeps what stages have made; null where it keeps nothing (see `remembering`).
  std::shared_ptr<run_results> results() const { return results_; }
  /// What `work()` returns on the process that leads, on all; see the function `once` of any executor.
  byte_buffer once(const std::function<byte_buffer()>& work) const { return once_(work); }
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    return detail::checked_outcomes(run_, name_, count, task, options);
  }

private:
  std::string name_;
  int workers_;
  bool shares_process_;
  any_communicator network_;
  std::shared_ptr<run_results> results_;
  std::function<byte_buffer(const std::function<byte_buffer()>&)> once_;
  detail::task_runner run_;
};
static_assert(executor<any_executor>);

} // namespace dovetail
