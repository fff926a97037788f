/// @file
/// The interface angles of a mesh that no background mesh says anything about.
#pragma once

#include "dovetail/decomposition/forced_angles.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"
#include "dovetail/sizing/concepts.hpp"

namespace dovetail::baselines {

namespace detail {

/// The angles of interfaces and beside them; what the CAD forces is marked.
inline interface_angles angles_of_interfaces(const fine_skeleton& fine, const any_sizing& size,
                                             const any_simplification_rule& rule) {
  const wanted_angles wanted = wanted_angles_of<3>(rule);
  auto angles = measure_skeleton_angles(fine, wanted, {}, {}, mesh_state::valid);
  find_forced(angles, fine.sides, cad_of(fine), size, wanted);
  return angles;
}

} // namespace detail

} // namespace dovetail::baselines
