/// @file
/// Tasks that return values: how they come back from another thread, process or rank is not their caller's
/// business.
#pragma once

#include "dovetail/core/encoding.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/parallel/error_codec.hpp"
#include "dovetail/parallel/executor_services.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

/// What became of one task, with the value that it returned.
template <class T>
struct task_result {
  std::optional<T> value;           ///< nothing when the task failed
  std::string failure = {};         ///< why it failed: see `task_outcome`
  bool crashed = false;             ///< it ended its process
  bool timed_out = false;           ///< it took too long
  double seconds = 0;               ///< the task's own wall time
  std::uint64_t peak_rss_bytes = 0; ///< of the worker that ran it, when known
};

/// What a task gives that returns nothing.
struct no_value {};

namespace detail {

/// Errors that no other attempt mends: the disk, the sizes given, a policy where it may not run.
template <class Task, class Catch>
void catch_final_errors(const Task& task, const Catch& caught) {
  try {
    task();
  } catch (const io_error&) {
    caught(std::current_exception());
  } catch (const sizing_error&) {
    caught(std::current_exception());
  } catch (const usage_error&) {
    caught(std::current_exception());
  }
}

/// The values of tasks that run in this process: each puts its own in its place.
template <class T>
class values_in_place {
public:
  explicit values_in_place(std::size_t tasks) : values_(tasks), errors_(tasks) {}

  template <class Task>
  byte_buffer run(const Task& task, std::size_t i) {
    catch_final_errors([&] { values_[i].emplace(task(i)); },
                       [&](std::exception_ptr error) { errors_[i] = std::move(error); });
    return {};
  }
  T take(byte_buffer, std::size_t i) {
    if (errors_[i])
      std::rethrow_exception(errors_[i]);
    return *std::move(values_[i]);
  }

private:
  std::vector<std::optional<T>> values_;
  std::vector<std::exception_ptr> errors_;
};

/// The values of tasks that run anywhere: they come back as bytes, and so do errors.
template <encodable T>
class values_as_bytes {
public:
  explicit values_as_bytes(std::size_t) {}

  template <class Task>
  byte_buffer run(const Task& task, std::size_t i) const {
    byte_writer reply;
    catch_final_errors(
        [&] {
          const T value = task(i);
          reply.value(std::uint8_t{0});
          encode(reply, value);
        },
        [&](const std::exception_ptr& error) {
          reply = {};
          reply.value(std::uint8_t{1});
          encode(reply, encode_error(error));
        });
    return reply.take();
  }
  T take(byte_buffer bytes, std::size_t) const { // by value: the bytes go with each
    byte_reader from(bytes);
    if (from.value<std::uint8_t>() != 0)
      throw_error(decode<byte_buffer>(from));
    return decode<T>(from);
  }
};

template <class T, class Values, executor Executor, class Task>
std::vector<task_result<T>> map_tasks_by(Values values, const Executor& run, std::size_t count,
                                         const Task& task, const run_options& options) {
  auto outcomes = run_checked(
      run, count, [&](std::size_t i) { return values.run(task, i); }, options);
  std::vector<task_result<T>> results(count);
  for (std::size_t i = 0; i < count; ++i) {
    task_outcome& outcome = outcomes[i];
    results[i] = {{},
                  outcome.ok || !outcome.failure.empty() ? std::move(outcome.failure)
                                                         : "the executor gave no reason",
                  outcome.crashed,
                  outcome.timed_out,
                  outcome.seconds,
                  outcome.peak_rss_bytes};
    if (outcome.ok)
      results[i].value = values.take(std::move(outcome.result), i);
  }
  return results;
}

} // namespace detail

/// Runs `task(i)`, which returns a value, for i in [0, count), and gives what became of each, in order; a
/// task that returns nothing gives `no_value`. The result is on all ranks. A task that throws,
/// crashes or takes too long has failed; but where it throws an `io_error`, `sizing_error` or `usage_error`,
/// which no other attempt would mend, that of the first such task is thrown here. Complexity: the tasks' own;
/// and where they run in other processes two copies of each value, which must be `encodable`.
/// \param run any executor
/// \param count how many tasks there are
/// \param task is called with the number of a task, perhaps in another process
/// \param options names, limits and the order of tasks
template <executor Executor, class Task>
auto map_tasks(const Executor& run, std::size_t count, const Task& task, const run_options& options = {}) {
  using returned = std::invoke_result_t<const Task&, std::size_t>;
  if constexpr (std::is_void_v<returned>) {
    return map_tasks(
        run, count, [&](std::size_t i) { return task(i), no_value{}; }, options);
  } else {
    static_assert(encodable<returned>, "what a task returns must be encodable: see core/encoding.hpp");
    return run.shares_process() && !has_others(run)
               ? detail::map_tasks_by<returned>(detail::values_in_place<returned>(count), run, count, task,
                                                options)
               : detail::map_tasks_by<returned>(detail::values_as_bytes<returned>(count), run, count, task,
                                                options);
  }
}

/// The value of a task that must be done. Throws `time_limit_error` or `mesher_error` that names it.
template <class T>
T value_of(task_result<T> result, const std::string& task) {
  if (result.timed_out)
    throw time_limit_error(task + ": " + result.failure);
  if (!result.value)
    throw mesher_error(task + " failed: " + result.failure);
  return *std::move(result.value);
}

/// The values of tasks that must all be done, in order.
template <class T>
std::vector<T> values_of(std::vector<task_result<T>> results, const std::string& task) {
  std::vector<T> values;
  values.reserve(results.size());
  for (auto& result : results)
    values.push_back(value_of(std::move(result), task));
  return values;
}

} // namespace dovetail
