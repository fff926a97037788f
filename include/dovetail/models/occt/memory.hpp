/// @file
/// Whether OCCT failed for want of memory: it catches its own exceptions in many places and says then that a
/// file is bad.
#pragma once

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <limits>
#include <new>
#include <string>

#include <sys/resource.h>

namespace dovetail::occt {

/// Looks at the memory of the process from now on.
class memory_watch {
public:
  memory_watch() { errno = 0; }

  /// Throws `std::bad_alloc` when the last call that failed, failed for want of memory, or the process has
  /// come near the limit to its memory: what failed may not be the fault of the file.
  void throw_if_short() const {
    if (errno == ENOMEM || is_near_limit())
      throw std::bad_alloc();
  }

private:
  /// An array that is to grow is not counted where it could not.
  static bool is_near_limit() {
    constexpr std::uint64_t array = 16 << 20;
    rlimit allowed{};
    if (::getrlimit(RLIMIT_AS, &allowed) != 0 || allowed.rlim_cur == RLIM_INFINITY)
      return false;
    std::ifstream status("/proc/self/status");
    std::string what;
    std::uint64_t kilobytes = 0;
    while (status >> what) {
      if (what == "VmPeak:" && status >> kilobytes)
        return 1024 * kilobytes + array > allowed.rlim_cur;
      status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return false;
  }
};

} // namespace dovetail::occt
