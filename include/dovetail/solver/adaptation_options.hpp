/// @file
/// The options of `adapt`.
#pragma once

namespace dovetail {

/// How a mesh is adapted.
struct adaptation_options {
  double growth = 0.25;          ///< most that the size grows per length, where sizes are values at points
  double feature_angle_deg = 40; ///< edges at which the boundary turns by more stay where they are
};

} // namespace dovetail
