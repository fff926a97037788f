/// @file
/// What `parameters.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/pipeline/parameters.hpp"

namespace dovetail {

DOVETAIL_INLINE improvement::native default_background_improver() {
  return improvement::native{.target_angle = 28,
                             .stubborn_angle = 15,
                             .bad_angle = 0,
                             .passes = 1,
                             .hard_passes = 1,
                             .search_iterations = 1,
                             .statistics = false};
}

} // namespace dovetail
