/// @file
/// How many processors this process may use.
#pragma once

#include <algorithm>
#include <thread>

#include <sched.h>

namespace dovetail::parallel {

/// At least one. Those that the process is bound to, by `taskset`, a batch system or `mpirun`, are counted,
/// not those of the machine: two workers on one processor are slower than one.
inline int available_processors() {
  cpu_set_t bound;
  CPU_ZERO(&bound);
  const int count = ::sched_getaffinity(0, sizeof bound, &bound) == 0
                        ? CPU_COUNT(&bound)
                        : static_cast<int>(std::thread::hardware_concurrency()); // over 1,024 processors
  return std::max(1, count);
}

} // namespace dovetail::parallel
