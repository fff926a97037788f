/// @file
/// Of ours: what the angle is worth that the paper's rule keeps between interfaces (section 3.3).
#pragma once

#include "common.hpp"

#include <string>
#include <utility>
#include <vector>

namespace dovetail::app::experiments {

/// From no simplification to 50 degrees, on a background mesh as it comes from the mesher and on one that was
/// improved.
inline std::vector<experiment_run> threshold_runs() {
  std::vector<experiment_run> runs;
  struct background_mesh {
    std::string name;
    std::vector<std::string> options;
  };
  for (const background_mesh& background :
       {background_mesh{"raw", {"--background-improver", "none"}}, background_mesh{"improved", {}}}) {
    const auto add = [&](const std::string& rule, const std::vector<std::string>& more) {
      experiment_run run{background.name + ", " + rule, "", "", "", background.options, 121e6};
      run.options.insert(run.options.end(), more.begin(), more.end());
      runs.push_back(std::move(run));
    };
    add("no rule", {"--simplifier", "none"});
    for (const char* angle : {"0", "10", "20", "30", "40", "50"})
      add(angle, {"--dihedral-angle", angle});
  }
  return on_models_and_seeds(runs);
}

inline experiment thresholds() {
  return {.name = "thresholds",
          .title = "The angle that the simplification keeps, on a raw and on an improved background mesh",
          .runs = threshold_runs(),
          .rows = interface_rows(),
          .notes = {"Runs are named by the model, the background mesh and the rule: none, or the paper's "
                    "with faces of at least 30 degrees that include at least so many with each other and "
                    "the surface."},
          .run_per_line = true};
}

} // namespace dovetail::app::experiments
