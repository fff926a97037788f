/// @file
/// Table 3 of the paper: one mesh by 16 to 128 workers.
#pragma once

#include "common.hpp"

namespace dovetail::app::experiments {

inline experiment table3() {
  return {.name = "table3",
          .title = "The third aircraft by 16 to 128 workers",
          .runs = runs_of("table3", "aircraft", {"16", "32", "64", "128"}),
          .rows = rows_of_steps(),
          .notes = {no_repartitioning}};
}

} // namespace dovetail::app::experiments
