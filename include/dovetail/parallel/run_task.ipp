/// @file
/// What `run_task.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/failure_reasons.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/run_task.hpp"

#include <cstddef>
#include <exception>
#include <new>
#include <numeric>
#include <string>
#include <vector>

namespace dovetail::detail {

DOVETAIL_INLINE task_outcome run_task(const task_function& task, std::size_t index) {
  task_outcome outcome;
  const stopwatch clock;
  try {
    outcome.result = task(index);
    outcome.ok = true;
  } catch (const time_limit_error& e) {
    outcome.failure = e.what();
    outcome.timed_out = true;
  } catch (const std::bad_alloc&) {
    outcome.failure = out_of_memory;
  } catch (const std::exception& e) {
    outcome.failure = e.what();
  } catch (...) {
    outcome.failure = "an exception that is not a std::exception";
  }
  outcome.seconds = clock.seconds();
  return outcome;
}

DOVETAIL_INLINE void require_done(const task_outcome& outcome, const std::string& policy) {
  if (outcome.timed_out)
    throw time_limit_error(policy + ": " + outcome.failure);
  if (!outcome.ok)
    throw mesher_error(policy + " failed: " + outcome.failure);
}

DOVETAIL_INLINE std::vector<std::size_t> start_order(std::size_t count, const run_options& options) {
  std::vector<std::size_t> order = options.order;
  if (order.empty()) {
    order.resize(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
  }
  std::vector<bool> seen(count, false);
  for (const std::size_t task : order) {
    if (order.size() != count || task >= count || seen[task])
      throw usage_error("run_options::order must list each of the " + std::to_string(count) +
                        " tasks exactly once");
    seen[task] = true;
  }
  return order;
}

} // namespace dovetail::detail
