/// @file
/// Table 9 of the paper, its Algorithm 1: the largest mesh by 32 to 512 workers.
#pragma once

#include "common.hpp"

namespace dovetail::app::experiments {

inline experiment table9() {
  return {.name = "table9",
          .title = "The fourth aircraft by 32 to 512 workers",
          .runs = runs_of("table9", "aircraft", {"32", "64", "128", "256", "512"}),
          .rows = {workers_row(),
                   background_row(),
                   elements_row(),
                   subdomains_row(),
                   scheme_row(),
                   decomposition_row(),
                   {"Other steps", "s", 2, {{"/other"}}, {other_seconds()}},
                   relative_speed_row()},
          .notes = {no_repartitioning}};
}

} // namespace dovetail::app::experiments
