/// @file
/// Rows of a comparison that belong together: what differs only by simplification, and what differs only by
/// what does not matter for the elements' shapes.
#pragma once

#include "compare_rows.hpp"

#include <string>
#include <vector>

namespace dovetail::app {

/// What decides how good elements are.
struct meshing_policies {
  std::string mesher;
  std::string improver;

  std::string name() const { return mesher + " + " + improver; }
  friend bool operator==(const meshing_policies&, const meshing_policies&) = default;
};

/// The same decomposition made with and without simplification; both rows went well.
struct simplification_pair {
  comparison_row with;
  comparison_row without;

  std::string name() const { return with.policies.partitioner + " + " + with.policies.mesher; }
};

meshing_policies meshing_of(const comparison_row& row);

/// The different ones, in the order of the rows.
std::vector<meshing_policies> distinct_meshings(const std::vector<comparison_row>& rows);

/// For each mesher and improver the first row that went well, of those with simplification if there is one.
std::vector<comparison_row> first_of_each_meshing(const comparison& compared);

/// One pair for each partitioner and mesher: improvers have no influence on interfaces.
std::vector<simplification_pair> simplification_pairs(const comparison& compared);

} // namespace dovetail::app
