/// @file
/// Puts next to each other in memory what is next to each other in space: points along a Hilbert curve,
/// elements by their first point on it. Work that goes from an element to its neighbours then waits for
/// memory as rarely in a large mesh as in a small one.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cstdint>
#include <vector>

namespace dovetail::improvement {

namespace detail {

struct placed_point {
  std::uint64_t place;
  local_id point;
};

/// The numbers of the points in the order of the curve.
std::vector<placed_point> along_curve(const std::vector<vec3>& points);

} // namespace detail

/// Renumbers points and elements as said above; returns the number that each point had. The elements' corners
/// keep their order. O(points + elements); the elements must name points that exist.
std::vector<local_id> order_along_curve(simplicial_mesh<3>& mesh);

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/tetrahedra/curve_order.ipp"
#endif
