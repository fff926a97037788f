/// @file
/// Any executor behind one type, so that the stages are compiled once and not once per executor.
#pragma once

#include "dovetail/parallel/concepts.hpp"

#include <concepts>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Holds any executor by value; an executor converts to it. A run costs one indirect call.
class any_executor {
public:
  template <class E>
    requires(!std::same_as<E, any_executor> && executor<E>)
  any_executor(E policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)), workers_(static_cast<int>(policy.workers())),
        shares_process_(policy.shares_process()),
        run_([held = std::move(policy)](std::size_t count, const task_function& task,
                                        const run_options& options) {
          return held.run(count, task, options);
        }) {}

  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  int workers() const { return workers_; }
  bool shares_process() const { return shares_process_; }
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    return run_(count, task, options);
  }

private:
  std::string name_;
  int workers_;
  bool shares_process_;
  std::function<std::vector<task_outcome>(std::size_t, const task_function&, const run_options&)> run_;
};
static_assert(executor<any_executor>);

} // namespace dovetail
