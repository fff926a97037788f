/// @file
/// Figure 10 of the paper: relative speeds of the steps, from Tables 2 and 3.
#pragma once

#include "common.hpp"

namespace dovetail::app::experiments {

inline experiment fig10() {
  const std::vector<std::string> sizes = {"F16-I", "F16-II", "F16-III", "F16-IV"};
  const std::vector<std::string> workers = {"16", "32", "64", "128"};
  const std::vector<std::string> speeds = {"All steps", "Domain decomposition", "Mesh generation",
                                           "Mesh improvement"};
  experiment result{.name = "fig10",
                    .title = "Relative speed of each step",
                    .runs = runs_of("table2", "aircraft", sizes),
                    .rows = {elements_row(), workers_row(), speed_row(speeds[0], "scheme", all_seconds()),
                             speed_row(speeds[1], "decomposition", decomposition_seconds()),
                             speed_row(speeds[2], "generation", seconds_of({"meshing"})),
                             speed_row(speeds[3], "improvement", seconds_of({"improvement"}))},
                    .notes = {"The paper's speeds are those of its Tables 2 and 3.", no_repartitioning},
                    .plots = {{"Relative speed by elements", "Tetrahedra", speeds, sizes, true},
                              {"Relative speed by workers", "Workers", speeds, workers, true}}};
  const auto more = runs_of("table3", "aircraft", workers);
  result.runs.insert(result.runs.end(), more.begin(), more.end());
  return result;
}

} // namespace dovetail::app::experiments
