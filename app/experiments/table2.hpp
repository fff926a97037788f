/// @file
/// Table 2 of the paper: meshes of four sizes by the same workers.
#pragma once

#include "common.hpp"

namespace dovetail::app::experiments {

inline experiment table2() {
  return {.name = "table2",
          .title = "Four sizes of the aircraft, 32 workers",
          .runs = runs_of("table2", "aircraft", {"F16-I", "F16-II", "F16-III", "F16-IV"}),
          .rows = rows_of_steps(),
          .notes = {no_repartitioning}};
}

} // namespace dovetail::app::experiments
