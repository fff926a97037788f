/// @file
/// The interface angles of a mesh that no background mesh says anything about.
#pragma once

#include "dovetail/baselines/element_layers.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/forced_angles.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::baselines {

namespace detail {

/// The angles of interfaces and beside them; what the CAD forces is marked.
inline interface_angles angles_of_interfaces(const fine_skeleton& fine, const any_sizing& size,
                                             double threshold_deg) {
  std::vector<triangle_origin> origins;
  for (std::size_t s = 0; s < fine.sides.size(); ++s)
    origins.push_back(is_interface(fine, s) ? triangle_origin::kept : triangle_origin::cad);
  auto angles = measure_interface_angles({span_of(fine.points),
                                          span_of(fine.sides),
                                          span_of(fine.subdomains),
                                          span_of(origins),
                                          {},
                                          mesh_state::valid},
                                         threshold_deg);
  find_forced(angles, fine.sides, {fine.points, fine.sides, fine.side_hosts, fine.curve_edges, fine.curves},
              size, threshold_deg);
  return angles;
}

} // namespace detail

} // namespace dovetail::baselines
