/// @file
/// What `available_processors.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/available_processors.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

#include <sched.h>

namespace dovetail::parallel {

DOVETAIL_INLINE std::vector<std::int32_t> bound_processors() {
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

} // namespace dovetail::parallel
