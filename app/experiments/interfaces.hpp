/// @file
/// Of ours: what each treatment of interfaces is worth to the elements at them (paper, section 3.3, and what
/// we have added to it).
#pragma once

#include "common.hpp"

#include <string>
#include <utility>
#include <vector>

namespace dovetail::app::experiments {

/// A run by five seeds of METIS, which are shown as one.
inline experiment_run by_seeds(const experiment_run& run) {
  const auto with_seed = [&](const std::string& seed) {
    experiment_run one = run;
    one.options.insert(one.options.end(), {"--partitioner", "metis:" + seed});
    return one;
  };
  experiment_run first = with_seed("1");
  for (const std::string seed : {"2", "3", "4", "5"}) {
    first.beside.push_back(with_seed(seed));
    first.beside.back().label = "seed " + seed;
  }
  return first;
}

/// Each model in one piece, and in pieces by all that can be done for interfaces, or not.
inline std::vector<experiment_run> treatment_runs() {
  using words = std::vector<std::string>;
  using treatment = std::pair<std::string, words>;
  constexpr double elements = 30e6, per_subdomain = 3000; // at the default scale 100 subdomains
  const treatment backgrounds[] = {{"raw", {"--background-improver", "none"}}, {"improved", {}}};
  const treatment repairs[] = {{"no repair", {"--segment-matching", "off", "--local-repartition", "off"}},
                               {"repair", {}}};
  const treatment rules[] = {{"no rule", {"--simplifier", "none"}}, {"rule", {"--simplifier", "paper"}}};
  const words native{"--mesher", "native"};
  std::vector<experiment_run> runs;
  for (const std::string model : {"aircraft", "combustor", "orbiter"}) {
    runs.push_back({model + ", one piece", model, "", "", native, elements, elements});
    for (const auto& [background, of_background] : backgrounds)
      for (const auto& [repair, of_repair] : repairs)
        for (const auto& [rule, of_rule] : rules) {
          const std::string label = model + ", " + background + ", " + repair + ", " + rule;
          experiment_run run{label, model, "", "", native, elements, per_subdomain};
          for (const words& more : {of_background, of_repair, of_rule})
            run.options.insert(run.options.end(), more.begin(), more.end());
          runs.push_back(by_seeds(run));
        }
  }
  return runs;
}

inline std::vector<experiment_row> treatment_rows() {
  const auto row = [](const std::string& label, const std::string& unit, int digits, const figure& ours) {
    experiment_row mean{label, unit, digits, {}, ours};
    mean.is_mean = true;
    return mean;
  };
  const auto share = [](const std::string& what, const std::string& of, double times) {
    return figure{{what}, {{of}}, {}, times};
  };
  const std::string touching = "/at_interfaces/touching/", rest = "/at_interfaces/rest/";
  return {row("Subdomains", "", 0, {{"/subdomains"}}),
          row("Unforced interface angles under what the rule wants", "", 1,
              {{"/interfaces/refused", "/interfaces/remeshing"}}),
          row("Touching an interface", "% of elements", 0, share(touching + "elements", "/elements", 100)),
          row("Smallest angle there", "degrees", 1, {{touching + "min_dihedral_deg"}}),
          row("Mean smallest angle there", "degrees", 2, {{touching + "mean_min_dihedral_deg"}}),
          row("Bad there", "per million", 1, share(touching + "bad", touching + "elements", 1e6)),
          row("Low quality there", "per million", 0, share(touching + "low", touching + "elements", 1e6)),
          row("Mean smallest angle two rings on", "degrees", 2, {{rest + "mean_min_dihedral_deg"}}),
          row("Low quality two rings on", "per million", 0, share(rest + "low", rest + "elements", 1e6)),
          row("Smallest angle of all", "degrees", 1, {{"/quality/min_dihedral_deg"}}),
          row("Low quality of all", "per million", 0, {{"/quality/low_per_million"}})};
}

inline experiment interfaces() {
  return {
      .name = "interfaces",
      .title = "Elements at interfaces, by what is done for interfaces",
      .runs = treatment_runs(),
      .rows = treatment_rows(),
      .notes = {"Means over five seeds of the partitioner, with 95 % intervals of the mean (Student's t).",
                "Raw or improved: the background mesh. Repair: segment matching and local repartition. "
                "Two rings on: elements that neither touch an interface nor share a vertex with one that "
                "does; in one piece these are all."},
      .run_per_line = true};
}

} // namespace dovetail::app::experiments
