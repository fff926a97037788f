/// @file
/// Table 5 of the paper: quality by the smallest dihedral angle.
#pragma once

#include "common.hpp"

namespace dovetail::app::experiments {

/// Tetrahedra with their smallest dihedral angle between two whole degrees.
inline experiment_row angles_row(const std::string& label, const std::string& paper, int from, int to) {
  experiment_row row{label, "", 0, {{"/" + paper}}, {}};
  for (int degree = from; degree < to; ++degree)
    row.ours.sum.push_back("/quality/histogram/min_dihedral/" + std::to_string(degree));
  return row;
}

inline experiment table5() {
  return {.name = "table5",
          .title = "Quality of the first aircraft, whole and in subdomains, and of the third",
          .runs = runs_of("table5", "aircraft", {"F16-I, 1", "F16-I, 32", "F16-III, 128"}),
          .rows = {workers_row(),
                   elements_row(),
                   subdomains_row(),
                   {"Smallest dihedral angle", "degrees", 1, {{"/angle"}}, {{"/quality/min_dihedral_deg"}}},
                   angles_row("Tetrahedra from 0 to 6 degrees", "from_0", 0, 6),
                   angles_row("Tetrahedra from 6 to 12 degrees", "from_6", 6, 12),
                   angles_row("Tetrahedra from 12 to 18 degrees", "from_12", 12, 18),
                   angles_row("Tetrahedra from 18 to 24 degrees", "from_18", 18, 24),
                   angles_row("Tetrahedra under 12 degrees (bad)", "bad", 0, 12),
                   angles_row("Tetrahedra under 24 degrees (low quality)", "low", 0, 24)},
          .notes = {"Numbers of tetrahedra are of meshes that are smaller than the paper's by the scale.",
                    "The mesh does not depend on the number of workers. With one worker it is made in one "
                    "piece, as by the paper's sequential mesher."}};
}

} // namespace dovetail::app::experiments
