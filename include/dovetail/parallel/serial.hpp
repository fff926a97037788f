/// @file
/// The executor that does one task after the other, here.
#pragma once

#include "dovetail/parallel/concepts.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::parallel {

/// A model of `executor`; the library's default. A task that crashes ends the process, and one that hangs is
/// not interrupted: `run_options::limit_seconds` is not enforced.
struct serial {
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options = {}) const;
  int workers() const { return 1; }
  bool shares_process() const { return true; }
};

static_assert(executor<serial>);

} // namespace dovetail::parallel

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/serial.ipp"
#endif
