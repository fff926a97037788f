/// @file
/// Pages of 2 MiB in the heap of a process that forks workers.
#pragma once

#include <cstdint>
#include <cstdlib>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace dovetail::app {

/// From its construction on, asks for large pages where the heap grows: to fork a worker, the tables of pages
/// of its parent are copied, which takes 10 ms for every 300 MB in pages of 4 KiB. glibc; only hints.
class huge_pages {
public:
  huge_pages() {
    constexpr int grows_by = 64 << 20; // a large page is used only where the heap has grown over all of it
    ::mallopt(M_TOP_PAD, grows_by);
    ::mallopt(M_TRIM_THRESHOLD, 2 * grows_by);
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20); // the most that there may be, and what it would grow to
  }

  /// For all that the heap has grown since.
  void ask() const {
    const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0)) / page * page;
    if (end > begin_)
      ::madvise(reinterpret_cast<void*>(begin_), end - begin_, MADV_HUGEPAGE);
  }

private:
  static constexpr std::uintptr_t page = std::uintptr_t{2} << 20;
  std::uintptr_t begin_ = (reinterpret_cast<std::uintptr_t>(::sbrk(0)) + page - 1) / page * page;
};

} // namespace dovetail::app
