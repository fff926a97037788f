/// @file
/// What the paper calls the entire scheme: which of a run's times are in it.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

/// Parts of a run, as its report names their times. Domain decomposition is all up to the meshing of pieces,
/// by simplification or by bisection; or the partition of a mesh that is fine already.
inline std::vector<std::string> decomposition_parts() {
  return {"background",   "simplification", "partition",     "skeleton",
          "intersection", "bisection",      "fine_partition"};
}
/// Mesh generation, redistribution and improvement, also where that goes back to the interfaces.
inline std::vector<std::string> other_parts() {
  return {"meshing",        "improvement", "redistribution", "first_pass",
          "between_passes", "second_pass", "writing_back"};
}
/// The entire scheme: in its Tables 2, 3, 8 and 9 the paper's times of these add up to it. Neither the
/// reading of the model ("geometry") is in it nor the search of sizes for a number of elements ("scaling"),
/// nor the pass that checks, counts and writes finished pieces ("output").
inline std::vector<std::string> scheme_parts() {
  std::vector<std::string> parts = decomposition_parts();
  const std::vector<std::string> others = other_parts();
  parts.insert(parts.end(), others.begin(), others.end());
  return parts;
}

/// The part to which a stage of a trace belongs; of one that no run of the driver has, "output", which is not
/// in the entire scheme.
inline std::string part_of_stage(const std::string& stage) {
  constexpr std::array<std::pair<const char*, const char*>, 29> parts{
      {{"geometry", "geometry"},
       {"reading", "geometry"},
       {"planning", "background"},
       {"background surface", "background"},
       {"coarse surface", "background"},
       {"background volume", "background"},
       {"simplification", "simplification"},
       {"partition", "partition"},
       {"lines", "skeleton"},
       {"matching", "skeleton"},
       {"skeleton", "skeleton"},
       {"intersection", "intersection"},
       {"recursive bisection", "bisection"},
       {"fine partition", "fine_partition"},
       {"meshing", "meshing"},
       {"meshing again", "meshing"},
       {"redistributing elements", "redistribution"},
       {"simplifying pieces", "redistribution"},
       {"cutting pieces", "redistribution"},
       {"moving elements", "redistribution"},
       {"improving pieces", "first_pass"},
       {"first pass", "first_pass"},
       {"collection", "between_passes"},
       {"redistribution", "between_passes"},
       {"second pass", "second_pass"},
       {"writing back", "writing_back"},
       {"second order", "output"},
       {"finishing", "output"},
       {"reading back", "output"}}};
  const auto* const found =
      std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.first == stage; });
  return found == parts.end() ? "output" : found->second;
}

} // namespace dovetail::app
