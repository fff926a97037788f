/// @file
/// Smaller sizes where surfaces cross, round by round.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/intersection/suppression.hpp"
#include "dovetail/sizing/size_balls.hpp"

#include <array>
#include <span>
#include <vector>

namespace dovetail {

/// Where no round of refinement is left.
[[noreturn]] void throw_crossing_faces(const geometry_topology& topology, std::array<local_id, 2> faces);

/// Many triangles cross at one place, where one ball does: the crossings that lie in none before them that is
/// at most a fifth larger. About n log n: they are looked for in cells of their size, of each power of two.
std::vector<surface_crossing> one_of_each_place(std::span<const surface_crossing> crossings);

/// Half of the triangles' edges around crossings: the sizes for another attempt.
std::vector<size_ball> balls_around(std::span<const surface_crossing> crossings);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/intersection/crossing_refinement.ipp"
#endif
