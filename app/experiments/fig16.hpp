/// @file
/// Figure 16 of the paper: time and speedup of the improvement, from Table 3.
#pragma once

#include "common.hpp"

namespace dovetail::app::experiments {

inline experiment fig16() {
  const std::vector<std::string> workers = {"16", "32", "64", "128"};
  experiment_row speedup = improvement_row();
  speedup.label = "Speedup of mesh improvement";
  speedup.unit = "";
  speedup.over_first = true;
  return {.name = "fig16",
          .title = "Time and speedup of the improvement",
          .runs = runs_of("table3", "aircraft", workers),
          .rows = {workers_row(), elements_row(), improvement_row(), speedup},
          .notes = {"The paper's times are those of its Table 3.", no_repartitioning},
          .plots = {{"Time of the improvement", "Workers", {"Mesh improvement"}, workers, true},
                    {"Speedup of the improvement", "Workers", {speedup.label}, workers, true}}};
}

} // namespace dovetail::app::experiments
