/// @file
/// What `topology_checks.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/geometry/topology_checks.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace dovetail {

DOVETAIL_INLINE void check_topology(const geometry_topology& topology) {
  const auto refuse = [](const char* kind, std::size_t number, const std::string& why) {
    throw geometry_error("the model's " + std::string(kind) + " " + std::to_string(number) + " " + why);
  };
  const auto exists = [](local_id id, const auto& entities) {
    return id >= 0 && static_cast<std::size_t>(id) < entities.size();
  };
  for (std::size_t v = 0; v < topology.vertices.size(); ++v)
    if (const vec3 p = topology.vertices[v].point;
        !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      refuse("vertex", v, "has a coordinate that is not finite");
  for (std::size_t c = 0; c < topology.curves.size(); ++c) {
    const auto& curve = topology.curves[c];
    for (const local_id v : curve.vertices)
      if (!exists(v, topology.vertices))
        refuse("curve", c, "ends at vertex " + std::to_string(v) + ", which does not exist");
    if (!std::isfinite(curve.t[0]) || !std::isfinite(curve.t[1]))
      refuse("curve", c, "has an infinite parameter range; its coordinates may be too large to measure");
    if (!(curve.t[0] < curve.t[1]))
      refuse("curve", c, "has no parameter range");
  }
  for (std::size_t f = 0; f < topology.faces.size(); ++f) {
    const auto& face = topology.faces[f];
    std::size_t in_loops = 0;
    for (const auto& loop : face.loops)
      in_loops += loop.size();
    if (in_loops != face.coedges.size())
      refuse("face", f,
             "has " + std::to_string(in_loops) + " coedges in its loops and " +
                 std::to_string(face.coedges.size()) + " of its own");
    for (const auto& coedge : face.coedges)
      if (!exists(coedge.curve, topology.curves))
        refuse("face", f, "is bounded by curve " + std::to_string(coedge.curve) + ", which does not exist");
    for (const local_id solid : face.solids)
      if (solid != no_id && !exists(solid, topology.solids))
        refuse("face", f, "bounds solid " + std::to_string(solid) + ", which does not exist");
  }
}

} // namespace dovetail
