/// @file
/// Table 9 of the paper: the largest mesh by 32 to 512 workers, with both algorithms.
#pragma once

#include "algorithm2.hpp"

namespace dovetail::app::experiments {

inline experiment table9() {
  experiment result{.name = "table9",
                    .title = "The fourth aircraft by 32 to 512 workers, and by bisection of the fine surface",
                    .runs = runs_of_both("table9", "table9", {"32", "64", "128", "256", "512"}),
                    .rows = {workers_row(),
                             background_row(),
                             elements_row(),
                             subdomains_row(),
                             scheme_row(),
                             decomposition_row(),
                             {"Other steps", "s", 2, {{"/other"}}, {other_seconds()}},
                             relative_speed_row()},
                    .notes = notes_on_second};
  const auto second = second_rows("", "_2");
  result.rows.insert(result.rows.end(), second.begin(), second.end());
  result.rows.push_back(gap_row("/gap"));
  return result;
}

} // namespace dovetail::app::experiments
