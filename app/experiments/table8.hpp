/// @file
/// Table 8 of the paper: Algorithm 2, one mesh by 16 to 128 workers.
#pragma once

#include "algorithm2.hpp"

namespace dovetail::app::experiments {

inline experiment table8() {
  return table_of_second("table8", "Bisection of the fine surface: the third aircraft by 16 to 128 workers",
                         runs_of_both("table3", "table8", {"16", "32", "64", "128"}));
}

} // namespace dovetail::app::experiments
