/// @file
/// What a comparison says of the method's claim: runs with and without simplification, side by side.
#pragma once

#include "compare_rows.hpp"

#include <string>
#include <vector>

namespace dovetail::app {

/// The same decomposition with and without simplification; rows of a comparison.
struct simplified_pair {
  std::string name; ///< of what both have in common
  const comparison_row* with;
  const comparison_row* without;
};

/// Of the rows that went well, once for each partitioner, mesher and simplifier: improvers have no influence
/// on interfaces.
std::vector<simplified_pair> pairs_of(const comparison& compared);

/// What was measured, in sentences. There must be pairs.
std::vector<std::string> answers_of(const comparison& compared, const std::vector<simplified_pair>& pairs);

} // namespace dovetail::app
