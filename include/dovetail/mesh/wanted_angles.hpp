/// @file
/// The interface angles that a rule of simplification wants; the stages after it measure against them.
#pragma once

namespace dovetail {

/// Interface angles below these are too small. In degrees.
struct wanted_angles {
  double face_deg = 0;     ///< of the corners of an interface face; in D = 2 it is an edge, and has none
  double dihedral_deg = 0; ///< between an interface face and the next one, or the surface
};

} // namespace dovetail
