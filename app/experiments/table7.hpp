/// @file
/// Table 7 of the paper: Algorithm 2, meshes of four sizes by the same workers.
#pragma once

#include "algorithm2.hpp"

namespace dovetail::app::experiments {

inline experiment table7() {
  experiment result{.name = "table7",
                    .title = "Bisection of the fine surface: four sizes of the aircraft, 32 workers",
                    .runs = runs_of_both("table2", "table7", {"F16-I", "F16-II", "F16-III", "F16-IV"}),
                    .rows = second_rows("/" + second_algorithm),
                    .notes = notes_on_second};
  result.rows.insert(result.rows.begin(), {workers_row(), scheme_row()});
  result.rows[1].label = "Algorithm 1: entire scheme";
  result.rows.push_back(gap_row("/" + second_algorithm + "/gap"));
  return result;
}

} // namespace dovetail::app::experiments
