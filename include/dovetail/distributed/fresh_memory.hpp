/// @file
/// Runs a function on a stack and a heap that nothing has used before, for libraries whose results depend on
/// the order of addresses or on what they failed to initialise. glibc.
#pragma once

#include "dovetail/distributed/stack_overflow.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <thread>

#include <malloc.h>
#include <sys/mman.h>

namespace dovetail::detail {

/// Asks for pages of 2 MiB where the heap of the calling thread, which must not be the first one, will grow.
/// Only a hint: without it a mesher that fills 100 MiB spends a fifth of its time on 4 KiB page faults.
inline void prefer_huge_pages_in_heap() {
  constexpr std::uintptr_t heap_size = std::uintptr_t{64} << 20; // glibc aligns heaps of threads to this
  void* const first = std::malloc(1);
  const std::uintptr_t heap = reinterpret_cast<std::uintptr_t>(first) & ~(heap_size - 1);
  ::madvise(reinterpret_cast<void*>(heap), heap_size, MADV_HUGEPAGE);
  std::free(first);
}

/// Calls `work` in a new thread and waits for it: its stack is fresh, and glibc gives it a heap of its own,
/// so neither holds traces of what the process did before. Meant for a forked child that does one job and
/// ends; allocations of 128 KiB and more get fresh pages from then on.
template <class Work>
auto on_fresh_memory(const Work& work) -> decltype(work()) {
  ::mallopt(M_MMAP_THRESHOLD, 128 << 10); // fixed: by default it follows what was freed before
  ::mallopt(M_TOP_PAD, 32 << 20);         // a huge page is used only where the heap has grown over all of it
  decltype(work()) result{};
  std::exception_ptr failure;
  std::thread([&] {
    watch_stack_of_thread();
    prefer_huge_pages_in_heap();
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
