/// @file
/// Table 8 of the paper: Algorithm 2, one mesh by 16 to 128 workers.
#pragma once

#include "algorithm2.hpp"

namespace dovetail::app::experiments {

inline experiment table8() {
  experiment result{.name = "table8",
                    .title = "Bisection of the fine surface: the third aircraft by 16 to 128 workers",
                    .runs = runs_of_both("table3", "table8", {"16", "32", "64", "128"}),
                    .rows = second_rows("/" + second_algorithm),
                    .notes = notes_on_second};
  result.rows.insert(result.rows.begin(), {workers_row(), scheme_row()});
  result.rows[1].label = "Algorithm 1: entire scheme";
  result.rows.push_back(gap_row("/" + second_algorithm + "/gap"));
  return result;
}

} // namespace dovetail::app::experiments
