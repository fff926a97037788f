/// @file
/// What the simplification decided about a side; the stages after it only read it.
#pragma once

#include <cstdint>

namespace dovetail {

/// Whether a side may become an interface, and why not.
enum class side_state : std::uint8_t {
  kept,    ///< may become an interface
  removed, ///< inside a super-element: can never become an interface
  refused, ///< ought to be removed, but the bound forbade it: may become an interface, at a high penalty
  fixed    ///< boundary, change of tag, non-manifold, or given as fixed
};

} // namespace dovetail
