/// @file
/// Runs a function on a stack and a heap that nothing has used before, for libraries whose results depend on
/// the order of addresses or on what they failed to initialise. glibc.
#pragma once

#include <exception>
#include <thread>

#include <malloc.h>

namespace dovetail::detail {

/// Calls `work` in a new thread and waits for it: its stack is fresh, and glibc gives it a heap of its own,
/// so neither holds traces of what the process did before. Meant for a forked child that does one job and
/// ends; allocations of 128 KiB and more get fresh pages from then on.
template <class Work>
auto on_fresh_memory(const Work& work) -> decltype(work()) {
  ::mallopt(M_MMAP_THRESHOLD, 128 << 10); // fixed: by default it follows what was freed before
  decltype(work()) result{};
  std::exception_ptr failure;
  std::thread([&] {
    try {
      result = work();
    } catch (...) {
      failure = std::current_exception();
    }
  }).join();
  if (failure)
    std::rethrow_exception(failure);
  return result;
}

} // namespace dovetail::detail
