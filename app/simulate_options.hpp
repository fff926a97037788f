/// @file
/// What `dovetail simulate` is asked for, as plain data.
#pragma once

#include "dovetail/experiments/simulation/simulate.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dovetail::app {

struct simulate_options {
  std::vector<std::string> traces; ///< one, or a smaller and a larger one
  std::optional<double> elements;  ///< of the mesh to predict; none: that of the trace
  std::vector<std::int64_t> workers = {1, 2, 4, 8, 16, 32, 64, 128, 256, 512};
  simulation::simulated_machine machine;      ///< but for the number of workers
  std::optional<std::int64_t> cores_per_node; ///< none: nothing is said of memory
  std::optional<double> memory_per_node;      ///< GB
};

} // namespace dovetail::app
