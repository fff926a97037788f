/// @file
/// Table 6 of the paper: two more models.
#pragma once

#include "common.hpp"

namespace dovetail::app::experiments {

inline std::vector<experiment_run> table6_runs() {
  const auto all_of = [](const std::string& model) {
    std::vector<std::string> columns;
    for (const char* workers : {"8", "16", "32", "64", "128", "256", "512"})
      columns.push_back(model + ", " + workers);
    return columns;
  };
  auto runs = runs_of("table6", "combustor", all_of("Combustor"));
  const auto orbiter = runs_of("table6", "orbiter", all_of("Shuttle"));
  runs.insert(runs.end(), orbiter.begin(), orbiter.end());
  return runs;
}

inline experiment table6() {
  return {.name = "table6",
          .title = "Combustor and orbiter by 8 to 512 workers",
          .runs = table6_runs(),
          .rows = {workers_row(), background_row(), elements_row(), decomposition_row(), scheme_row(),
                   relative_speed_row()},
          .notes = {"The combustor has one size everywhere here; the paper's sizes are smaller at its small "
                    "features."},
          .run_per_line = true};
}

} // namespace dovetail::app::experiments
