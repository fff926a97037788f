/// @file
/// The interface angles of D = 2: no small corner at a line that cuts a CAD face. Measured on the coarse
/// mesh, through its triangles, or between the first edges of the fine lines.
#pragma once

#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/mesh/require_valid.hpp"

#include <functional>
#include <span>

namespace dovetail {

/// A decomposed surface. In the result, `sides` are sides of `mesh`, and the first of `edge` is the
/// vertex.
struct corner_angles_input {
  const simplicial_mesh<2>& mesh;
  const side_table<2>& sides; ///< `build_sides(mesh)`
  std::span<const side_state> side_states;
  std::span<const local_id> part_of_element;
  /// Of a fine line: the direction in which it leaves a vertex; empty for the coarse mesh.
  std::function<vec3(local_id side, local_id vertex)> leaves = {};
  mesh_state mesh_is = mesh_state::unknown; ///< `valid`: `require_valid` has seen it
};

/// Measures the interface angles of D = 2. One between two fixed sides that themselves meet at less than the
/// threshold is forced. Linear in the mesh. Throws `mesh_error` when `require_valid` refuses the mesh, and
/// `usage_error` when there is not one state per side and one part per element.
interface_angles measure_corner_angles(const corner_angles_input& input, double threshold_deg = 50);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/corner_angles.ipp"
#endif
