/// @file
/// What `native_parameters.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/improver/native_parameters.hpp"

namespace dovetail::improvement {

DOVETAIL_INLINE native native::fast() {
  native preset;
  preset.target_angle = 24.5;
  preset.passes = 4;
  preset.search_iterations = 3;
  return preset;
}

DOVETAIL_INLINE native native::finest() {
  native preset;
  preset.target_angle = 35;
  preset.passes = 40;
  preset.hard_passes = 12;
  preset.global_passes = 1;
  preset.least_gain = 0.002;
  preset.search_iterations = 12;
  return preset;
}

DOVETAIL_INLINE native native::hard() {
  native preset = finest();
  preset.target_angle = 38;
  preset.stubborn_angle = 30;
  return preset;
}

} // namespace dovetail::improvement
