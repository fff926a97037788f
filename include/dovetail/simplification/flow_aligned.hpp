/// @file
/// A rule that keeps interfaces along a flow, given as a function of place (of the driver: along x): sides at
/// more than 60 degrees to it go, and of small dihedrals the side that is aligned less.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/simplification/rule_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace dovetail::simplifier {

/// Sides that the flow crosses at a large angle go, as far as the bound allows, so that boundary layers,
/// wakes and lines of an implicit solver stay in one subdomain; of small dihedrals, as in the paper's rule,
/// one side goes, but the one that is aligned less. A side's quality is 90 degrees minus its angle to the
/// flow; where nothing flows every side is good.
struct flow_aligned {
  /// The flow's direction at a point, of any length. It must be a pure function.
  std::function<vec3(vec3)> direction = [](vec3) { return vec3{1, 0, 0}; };
  double surface_deg = 90;          ///< edges at a larger angle to the flow are removed; 90: none
  double volume_deg = 60;           ///< faces at a larger angle to the flow are removed; 90: none
  double surface_dihedral_deg = 50; ///< smaller corners between lines of the surface are removed; 0: none
  double volume_dihedral_deg = 30;  ///< smaller dihedral angles between faces are removed; 0: none
  refusal_penalty penalty_of_refusal = {}; ///< of sides that the bound refuses to remove

  /// Throws `usage_error` without a direction.
  template <int D>
  side_judgement operator()(const simplicial_mesh<D>& mesh, const side_table<D>& sides) const {
    if (!direction)
      throw usage_error("simplifier::flow_aligned has no direction of the flow; give it a function");
    side_judgement judged{std::vector<double>(sides.size()), 90 - (D == 2 ? surface_deg : volume_deg),
                          D == 2 ? surface_dihedral_deg : volume_dihedral_deg};
    for (std::size_t s = 0; s < sides.size(); ++s)
      judged.quality[s] = 90 - angle_to_flow(corners(span_of(mesh.points), sides.vertices[s]));
    return judged;
  }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return is_worse(a, b); }
  std::optional<ridge_decision> propagate(const side_below& below) const { return as_below(below, 90); }
  double penalty(const deficit& missed) const { return penalty_of_refusal(missed); }

private:
  double angle_to_flow(const std::array<vec3, 2>& edge) const {
    const vec3 flow = direction((edge[0] + edge[1]) / 2);
    return norm(flow) > 0 ? std::min(between(edge[1] - edge[0], flow), 180 - between(edge[1] - edge[0], flow))
                          : 0;
  }
  double angle_to_flow(const std::array<vec3, 3>& face) const {
    const vec3 flow = direction((face[0] + face[1] + face[2]) / 3);
    const vec3 normal = cross(face[1] - face[0], face[2] - face[0]);
    return norm(flow) > 0 ? std::abs(90 - between(normal, flow)) : 0;
  }
  static double between(vec3 a, vec3 b) { return degrees_per_radian * angle_between(a, b); }
};
static_assert(simplification_rule<flow_aligned, 2> && simplification_rule<flow_aligned, 3>);

} // namespace dovetail::simplifier
