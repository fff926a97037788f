/// @file
/// Is a mesh as large as was planned?
#pragma once

#include "dovetail/core/number_text.hpp"
#include "dovetail/core/report.hpp"

#include <cmath>

namespace dovetail {

/// Of a mesh of `made` elements where `planned` were predicted: a warning in `summary`, the report of the
/// run, where it is more than half as large again, and large enough for its time and memory to matter. Small
/// features of a model are what does that: their edges are shorter than the sizes ask for.
inline void compare_with_plan(double planned, double made, report& summary) {
  constexpr double allowed = 1.5;
  constexpr double worth_telling = 10'000;
  if (planned <= 0 || made <= allowed * planned || made < worth_telling)
    return;
  summary.warnings.push_back(
      "the mesh has " + number_text(made) + " elements, and about " + number_text(std::round(planned)) +
      " were predicted: small features of the model need elements smaller than the sizes "
      "ask for");
}

} // namespace dovetail
