/// @file
/// The table of a comparison: its columns, defined once, and its forms on the terminal and as CSV.
#pragma once

#include "compare_rows.hpp"

#include <functional>
#include <string>
#include <vector>

namespace dovetail::app {

/// A column of numbers. The columns before these name the policies.
struct table_column {
  std::string key;     ///< in the CSV's head
  std::string heading; ///< short, for people
  std::string meaning; ///< one sentence
  int decimals = 0;
  std::function<double(const comparison_row&)> value; ///< NaN: there is nothing to say

  /// The number as text, empty when there is none or the row failed.
  std::string text(const comparison_row& row) const;
};

/// Elements, quality, interface angles, cut, imbalance.
std::vector<table_column> result_columns(int dimension);

/// Seconds per stage and in total.
std::vector<table_column> time_columns();

/// Two tables of aligned columns, and a line for each row that failed.
std::string terminal_text(const comparison& compared);

/// One line of keys, then one per row (RFC 4180). Columns: partitioner, mesher, improver, simplifier,
/// error, background_reused, then all of the above, mesh_hash, and where the comparison comes from.
std::string csv_text(const comparison& compared);

} // namespace dovetail::app
