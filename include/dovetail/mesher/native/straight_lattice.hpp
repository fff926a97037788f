/// @file
/// The points of a body-centred cubic lattice inside a piece with one size.
#pragma once

#include "dovetail/core/scattered.hpp"
#include "dovetail/mesher/native/interior_point_options.hpp"
#include "dovetail/mesher/native/piece_octree.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dovetail::detail {

/// Calls `visit(place)` for the places origin + (i, j, k) step, i, j and k all even or all odd, that lie in
/// [box.lower, box.upper): of boxes that fill a larger one each place is in one, whatever rounding does.
template <class Visit>
void for_each_lattice_place(const box3& box, vec3 origin, vec3 step, Visit&& visit) {
  const auto first = [&](int axis) {
    const auto is_below = [&](double i) { return origin[axis] + step[axis] * i < box.lower[axis]; };
    double i = std::ceil((box.lower[axis] - origin[axis]) / step[axis]);
    while (!is_below(i - 1))
      --i;
    while (is_below(i))
      ++i;
    return i;
  };
  const auto from = [](double least, bool odd) {
    return least + ((std::fmod(least, 2) != 0) != odd ? 1 : 0);
  };
  for (double i = first(0); origin.x + step.x * i < box.upper.x; ++i) {
    const bool odd = std::fmod(i, 2) != 0;
    for (double j = from(first(1), odd); origin.y + step.y * j < box.upper.y; j += 2)
      for (double k = from(first(2), odd); origin.z + step.z * k < box.upper.z; k += 2)
        visit(vec3{origin.x + step.x * i, origin.y + step.y * j, origin.z + step.z * k});
  }
}

/// About `wanted`, such that a whole number of steps is `length`, where a little more or less does.
inline double step_that_fits(double wanted, double length) {
  constexpr double most_change = 1.08;
  const double fitting = length / std::round(length / wanted);
  return fitting < most_change * wanted && wanted < most_change * fitting ? fitting : wanted;
}

/// The lattice's places that are inside and clear of the boundary, leaf by leaf. For a piece that
/// `is_uniform`.
inline std::vector<vec3> straight_lattice(const piece_octree& piece, const interior_point_options& options) {
  std::vector<vec3> points;
  const octree& tree = piece.tree();
  // Faces of the box that the piece fills are often faces of the piece: the first and the last points are as
  // near as they may.
  const double margin = 1.05 * options.clearance * piece.uniform_size();
  const box3 within = inflated(piece.bounds(), -margin);
  vec3 step;
  for (int axis = 0; axis < 3; ++axis)
    step[axis] =
        step_that_fits(0.5 * options.cell * piece.uniform_size(), within.upper[axis] - within.lower[axis]);
  const double clearance = options.clearance * piece.uniform_size();
  const double jitter = options.jitter * piece.uniform_size();
  std::uint64_t places = 0;
  std::optional<vec3> last_clear;
  bool last_is_inside = false;
  for (std::size_t n = 0; n < tree.leaf_count(); ++n) {
    const std::size_t leaf = tree.leaf(n);
    if (piece.is_outside(leaf))
      continue;
    for_each_lattice_place(tree.box(leaf), within.lower, step, [&](vec3 place) {
      const vec3 p = place + jitter * scattered_vector(places++);
      if (!piece.is_clear(leaf, p, clearance))
        return;
      // No triangle is between two clear places that close: both are inside, or none is.
      if (!last_clear || !(distance(*last_clear, p) < 2 * clearance))
        last_is_inside = piece.is_inside(leaf, p);
      last_clear = p;
      if (!last_is_inside)
        return;
      if (static_cast<double>(points.size()) >= options.most_points)
        throw_too_many_points(options.most_points);
      points.push_back(p);
    });
  }
  return points;
}

} // namespace dovetail::detail
