/// @file
/// Any executor behind one type, so that the stages are compiled once and not once per executor.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/self.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
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
        shares_process_(policy.shares_process()), network_(network_of(policy)) {
    if constexpr (detail::does_once<E>)
      once_ = [held = policy](const std::function<byte_buffer()>& work) { return held.once(work); };
    else
      once_ = [held = network_](const auto& work) mutable { return held.once(work); };
    if constexpr (detail::has_results<E>)
      results_ = policy.results();
    run_ = [held = std::move(policy)](std::size_t count, const task_function& task,
                                      const run_options& options) { return held.run(count, task, options); };
  }

  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  int workers() const { return workers_; }
  bool shares_process() const { return shares_process_; }
  /// Of the ranks that go through the same program; `self` where there is one process.
  any_communicator network() const { return network_; }
  /// Where it keeps what stages have made; null where it keeps nothing (see `remembering`).
  std::shared_ptr<run_results> results() const { return results_; }
  /// Whether what is not a task, files for example, is this process's to do: not on all ranks of `ranks`.
  bool leads() const { return network_.leads(); }
  /// Whether other processes go through the same program, so that what is made `once` has to be bytes.
  bool has_others() const { return network_.size() > 1; }
  /// What `work()` returns, made by the process that leads alone; an error of it is thrown by all. A value
  /// is sent to the others (`encodable`).
  template <class Work>
  auto once(const Work& work) const {
    using value = decltype(work());
    if constexpr (std::is_void_v<value>) {
      if (!has_others())
        work();
      else
        once_([&] { return work(), byte_buffer{}; });
    } else {
      return has_others() ? decoded<value>(once_([&] { return encoded<value>(work()); })) : work();
    }
  }
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const;

private:
  template <class E>
  static any_communicator network_of(const E& policy) {
    if constexpr (detail::has_network<E>)
      return policy.network();
    else
      return parallel::self{};
  }
  /// Each result ends with its task's number, so that none is lost or taken for another's.
  static task_function marked(const task_function& task);
  static bool take_mark(byte_buffer& result, std::size_t i);

  std::string name_;
  int workers_;
  bool shares_process_;
  any_communicator network_;
  std::shared_ptr<run_results> results_;
  std::function<byte_buffer(const std::function<byte_buffer()>&)> once_;
  std::function<std::vector<task_outcome>(std::size_t, const task_function&, const run_options&)> run_;
};
static_assert(executor<any_executor>);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/any_executor.ipp"
#endif
