/// @file
/// Table 7 of the paper: Algorithm 2, meshes of four sizes by the same workers.
#pragma once

#include "algorithm2.hpp"

namespace dovetail::app::experiments {

inline experiment table7() {
  return table_of_second("table7", "Bisection of the fine surface: four sizes of the aircraft, 32 workers",
                         runs_of_both("table2", "table7", {"F16-I", "F16-II", "F16-III", "F16-IV"}));
}

} // namespace dovetail::app::experiments
