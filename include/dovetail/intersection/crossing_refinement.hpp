/// @file
/// Smaller sizes where surfaces cross, round by round.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace dovetail {

/// Where no round of refinement is left.
[[noreturn]] inline void throw_crossing_faces(const geometry_topology& topology,
                                              std::array<local_id, 2> faces) {
  const auto name = [&](local_id f) {
    const std::string& given = topology.faces[static_cast<std::size_t>(f)].name;
    return "face " + std::to_string(f) + (given.empty() ? "" : " '" + given + "'");
  };
  throw intersection_error((faces[0] == faces[1]
                                ? "the surface of " + name(faces[0]) + " crosses itself or stays folded over"
                                : "the surfaces of " + name(faces[0]) + " and " + name(faces[1]) + " cross") +
                           ", also when refined; repair the model there or give a smaller size");
}

/// Half of the triangles' edges around crossings: the sizes for another attempt.
inline std::vector<size_ball> balls_around(std::span<const surface_crossing> crossings) {
  std::vector<size_ball> balls;
  for (const surface_crossing& crossing : crossings)
    balls.push_back({crossing.center, 2 * crossing.size, 0.5 * crossing.size});
  return balls;
}

} // namespace dovetail
