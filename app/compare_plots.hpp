/// @file
/// The plots of a comparison, as SVG that is part of a page.
#pragma once

#include "compare_claim.hpp"
#include "compare_rows.hpp"

#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

/// A bar per row that went well: the seconds of the stages, one after the other.
std::string plot_of_times(const comparison& compared);

/// A point per row that went well: low elements per million, against seconds.
std::string plot_of_quality(const comparison& compared);

/// A curve per mesher and improver: how many elements have which smallest angle.
std::string plot_of_angles(const comparison& compared);

/// The smallest angles at interfaces with and without simplification.
std::string plot_of_interfaces(const comparison& compared, const std::vector<simplified_pair>& pairs);

} // namespace dovetail::app
