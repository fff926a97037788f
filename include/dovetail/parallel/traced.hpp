/// @file
/// An executor that keeps a record of what it runs.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/execution_trace.hpp"
#include "dovetail/parallel/wraps.hpp"

#include <algorithm>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace dovetail::parallel {

/// A model of `executor`: another one, with a record of its batches and tasks. Each task notes its own times,
/// so this works over every executor, on all ranks, and costs 24 bytes and less than a microsecond per task.
/// Copies share the record. Clocks of several machines need not agree: each counts from its own beginning of
/// a batch.
class traced : public wraps<traced, any_executor> {
public:
  // Of nothing that converts: whether this type is an executor would hang on itself.
  template <std::same_as<any_executor> Executor>
  explicit traced(Executor run)
      : wraps(std::move(run)), record_(std::make_shared<record>()), origin_(clock::now()) {
    record_->trace.workers = workers();
  }

  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    const clock::time_point begun = clock::now();
    const auto stamped = [&](std::size_t i) {
      const clock::time_point task_begun = clock::now();
      byte_buffer result = task(i);
      const stamp mine{this_worker(), seconds_between(begun, task_begun),
                       seconds_between(task_begun, clock::now())};
      const auto* bytes = reinterpret_cast<const std::byte*>(&mine);
      result.insert(result.end(), bytes, bytes + sizeof mine);
      return result;
    };
    auto outcomes = wrapped.run(count, stamped, options);
    batch_span batch{options.stage, seconds_between(origin_, begun), seconds_between(origin_, clock::now())};
    std::vector<std::uint64_t> workers;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i].ok) {
        ++batch.failed;
        continue;
      }
      const stamp found = take_stamp(outcomes[i].result);
      workers.push_back(found.worker);
      batch.tasks.push_back({i, 0, found.begin, found.seconds, outcomes[i].result.size()});
    }
    number_workers(batch.tasks, workers);
    record_->trace.batches.push_back(std::move(batch));
    return outcomes;
  }
  byte_buffer once(const std::function<byte_buffer()>& work) const {
    auto& trace = record_->trace;
    const std::string stage = trace.stages.empty() ? "" : trace.stages.back().stage;
    const double begun = seconds_between(origin_, clock::now());
    double worked = 0;
    byte_buffer made = wrapped.once([&] {
      const clock::time_point work_begun = clock::now();
      byte_buffer result = work();
      worked = seconds_between(work_begun, clock::now());
      return result;
    });
    trace.batches.push_back({stage,
                             begun,
                             seconds_between(origin_, clock::now()),
                             {{.seconds = worked, .result_bytes = made.size()}},
                             0,
                             true});
    return made;
  }

  /// The same callbacks, which note the stages too. They hold the record, not this object.
  progress watch(progress given) const {
    return {.update =
                [kept = record_, origin = origin_, update = std::move(given.update)](
                    std::string_view stage, std::size_t done, std::size_t total) {
                  kept->begin_stage(stage, seconds_between(origin, clock::now()));
                  if (update)
                    update(stage, done, total);
                },
            .stop_requested = std::move(given.stop_requested)};
  }

  /// All until now. The last stage ends here.
  execution_trace trace() const {
    execution_trace until_now = record_->trace;
    until_now.seconds = seconds_between(origin_, clock::now());
    if (!until_now.stages.empty())
      until_now.stages.back().end = until_now.seconds;
    return until_now;
  }

private:
  using clock = std::chrono::steady_clock;

  struct stamp {
    std::uint64_t worker = 0;
    double begin = 0;
    double seconds = 0;
  };

  struct record {
    execution_trace trace;

    void begin_stage(std::string_view stage, double now) {
      if (!trace.stages.empty()) {
        if (trace.stages.back().stage == stage)
          return;
        trace.stages.back().end = now;
      }
      trace.stages.push_back({std::string(stage), now, now});
    }
  };

  static double seconds_between(clock::time_point begin, clock::time_point end) {
    return std::chrono::duration<double>(end - begin).count();
  }

  /// Tells apart threads, processes and machines.
  static std::uint64_t this_worker() {
    std::vector<char> host(256, '\0');
    ::gethostname(host.data(), host.size() - 1);
    return key_maker{}(host)(static_cast<std::int64_t>(::getpid()))(
               static_cast<std::int64_t>(std::hash<std::thread::id>{}(std::this_thread::get_id())))
        .key()
        .value;
  }

  static stamp take_stamp(byte_buffer& result) {
    stamp found;
    if (result.size() < sizeof found)
      throw usage_error("an executor gave another result than its task returned");
    std::memcpy(&found, result.data() + result.size() - sizeof found, sizeof found);
    result.resize(result.size() - sizeof found);
    return found;
  }

  static void number_workers(std::vector<task_span>& tasks, const std::vector<std::uint64_t>& workers) {
    std::map<std::uint64_t, double> first; // beginning of each worker's first task
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const auto [at, is_new] = first.try_emplace(workers[i], tasks[i].begin);
      at->second = std::min(at->second, tasks[i].begin);
    }
    std::vector<std::pair<double, std::uint64_t>> order;
    for (const auto& [worker, begin] : first)
      order.emplace_back(begin, worker);
    std::sort(order.begin(), order.end());
    std::map<std::uint64_t, int> number;
    for (const auto& [begin, worker] : order)
      number.emplace(worker, static_cast<int>(number.size()));
    for (std::size_t i = 0; i < tasks.size(); ++i)
      tasks[i].worker = number.at(workers[i]);
  }

  std::shared_ptr<record> record_;
  clock::time_point origin_;
};
static_assert(executor<traced>);

} // namespace dovetail::parallel
