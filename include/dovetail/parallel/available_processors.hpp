/// @file
/// Which processors this process may use.
#pragma once

#include <cstdint>
#include <vector>

namespace dovetail::parallel {

/// Their numbers, growing; at least one. Those that the process is bound to, by `taskset`, a batch system or
/// `mpirun`, not those of the machine: two workers on one processor are slower than one.
std::vector<std::int32_t> bound_processors();

/// How many there are.
inline int available_processors() {
  return static_cast<int>(bound_processors().size());
}

} // namespace dovetail::parallel

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/available_processors.ipp"
#endif
