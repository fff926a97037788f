/// @file
/// Of ours: where the simplification decides on the quality of a mesh, by background mesh, mesher and
/// improver.
#pragma once

#include "common.hpp"

#include <string>
#include <vector>

namespace dovetail::app::experiments {

/// With and without the paper's rule.
inline std::vector<experiment_run> rule_runs() {
  std::vector<experiment_run> runs;
  for (const std::string mesher : {"tetgen", "hxt"})
    for (const std::string improver : {"none", "native"})
      for (const std::string background : {"none", "native"})
        for (const std::string rule : {"none", "paper"})
          runs.push_back(
              {mesher + ", improver " + improver + ", background improver " + background + ", rule " + rule,
               "",
               "",
               "",
               {"--mesher", mesher, "--improver", improver, "--background-improver", background,
                "--simplifier", rule},
               28e6});
  return on_models_and_seeds(runs);
}

inline experiment rules() {
  return {.name = "rules",
          .title = "With and without simplification, by mesher, improver and background mesh",
          .runs = rule_runs(),
          .rows = interface_rows(),
          .notes = {"The improver works in subdomains whose interfaces are fixed."},
          .run_per_line = true};
}

} // namespace dovetail::app::experiments
