/// @file
/// Smaller sizes where surfaces cross, round by round.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

[[noreturn]] inline void throw_crossing_faces(const geometry_topology& topology, local_id first,
                                              local_id second) {
  const auto name = [&](local_id f) {
    const std::string& given = topology.faces[static_cast<std::size_t>(f)].name;
    return "face " + std::to_string(f) + (given.empty() ? "" : " '" + given + "'");
  };
  throw intersection_error("the surfaces of " + name(first) + " and " + name(second) +
                           " cross, also when refined; repair the model there or give a smaller size");
}

} // namespace detail

/// A field that gets smaller around the crossings of each round.
class crossing_refinement {
public:
  crossing_refinement(any_sizing plain, int most_rounds) : plain_(std::move(plain)), left_(most_rounds) {}

  /// The field of the next round: half of the triangles' edges around all crossings so far. Throws
  /// `intersection_error` naming both CAD faces of the first crossing when no round is left.
  any_sizing refine(std::span<const surface_crossing> crossings, const geometry_topology& topology) {
    if (left_-- <= 0)
      detail::throw_crossing_faces(topology, crossings.front().cad_faces[0], crossings.front().cad_faces[1]);
    for (const surface_crossing& crossing : crossings)
      balls_.push_back({crossing.center, 2 * crossing.size, 0.5 * crossing.size});
    return within_bounds(plain_, balls_, 0.3);
  }

  /// The key of the present field, given that of the plain one.
  content_key key(content_key plain) const { return balls_.empty() ? plain : key_maker(plain)(balls_).key(); }

private:
  any_sizing plain_;
  int left_;
  std::vector<size_ball> balls_;
};

} // namespace dovetail
