/// @file
/// Runs a library that has global state, or may crash, in a child process with fresh memory.
#pragma once

#include "dovetail/distributed/fresh_memory.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/parallel/map_tasks.hpp"

#include <cstddef>
#include <string>

namespace dovetail {

/// What `work()` returns in a child of this process. Throws what `map_tasks` and `value_of` throw, naming the
/// library: `mesher_error` when the child fails or crashes, `time_limit_error` when it takes longer than the
/// limit, the `sizing_error` of the work; `usage_error` when this process has other threads.
template <class Work>
auto run_in_child(const std::string& library, double limit_seconds, const Work& work) {
  run_options alone;
  alone.limit_seconds = limit_seconds;
  auto results = map_tasks(
      parallel::processes{1}, 1, [&](std::size_t) { return detail::on_fresh_memory(work); }, alone);
  return value_of(std::move(results.front()), library);
}

} // namespace dovetail
