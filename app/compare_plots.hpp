/// @file
/// The plots of a comparison, each as an inline SVG element. Rows that failed are left out.
#pragma once

#include "compare_rows.hpp"

#include <string>

namespace dovetail::app {

/// A bar per row: the seconds of the stages, one after the other.
std::string times_plot(const comparison& compared);

/// A point per row: low elements per million, against seconds.
std::string quality_plot(const comparison& compared);

/// A curve per mesher and improver: how many elements have which smallest angle.
std::string histogram_plot(const comparison& compared);

/// The smallest angles at interfaces with and without simplification, for each partitioner and mesher.
std::string interfaces_plot(const comparison& compared);

} // namespace dovetail::app
