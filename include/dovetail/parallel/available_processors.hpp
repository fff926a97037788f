/// @file
/// Which processors this process may use.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

#include <sched.h>

namespace dovetail::parallel {

/// Their numbers, growing; at least one. Those that the process is bound to, by `taskset`, a batch system or
/// `mpirun`, not those of the machine: two workers on one processor are slower than one.
inline std::vector<std::int32_t> bound_processors() {
  std::vector<std::int32_t> numbers;
  cpu_set_t bound;
  CPU_ZERO(&bound);
  if (::sched_getaffinity(0, sizeof bound, &bound) == 0) {
    for (int p = 0; p < CPU_SETSIZE; ++p)
      if (CPU_ISSET(p, &bound))
        numbers.push_back(p);
  } else { // over 1,024 processors
    numbers.resize(std::max(1U, std::thread::hardware_concurrency()));
    std::iota(numbers.begin(), numbers.end(), 0);
  }
  return numbers;
}

/// How many there are.
inline int available_processors() {
  return static_cast<int>(bound_processors().size());
}

} // namespace dovetail::parallel
