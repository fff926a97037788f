/// @file
/// The points of a body-centred cubic lattice inside a piece with one size.
#pragma once

#include "dovetail/core/scattered.hpp"
#include "dovetail/mesher/native/interior_point_options.hpp"
#include "dovetail/mesher/native/piece_octree.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail::detail {

/// Calls `visit(place)` for the places of the lattice {(i, j, k) / 2: all even or all odd} x cell from
/// `origin` that lie in [box.lower, box.upper).
template <class Visit>
void for_each_lattice_place(const box3& box, vec3 origin, double cell, Visit&& visit) {
  const double step = 0.5 * cell;
  const auto first = [&](int axis) { return std::ceil((box.lower[axis] - origin[axis]) / step); };
  const auto from = [](double least, bool odd) {
    return least + ((std::fmod(least, 2) != 0) != odd ? 1 : 0);
  };
  for (double i = first(0); origin.x + step * i < box.upper.x; ++i) {
    const bool odd = std::fmod(i, 2) != 0;
    for (double j = from(first(1), odd); origin.y + step * j < box.upper.y; j += 2)
      for (double k = from(first(2), odd); origin.z + step * k < box.upper.z; k += 2)
        visit(origin + step * vec3{i, j, k});
  }
}

/// The lattice's places that are inside and clear of the boundary, leaf by leaf. For a piece that
/// `is_uniform`.
inline std::vector<vec3> straight_lattice(const piece_octree& piece, const interior_point_options& options) {
  std::vector<vec3> points;
  const octree& tree = piece.tree();
  // Faces of the box that the piece fills are often faces of the piece: the first points are as near as they
  // may.
  const double margin = 1.05 * options.clearance * piece.uniform_size();
  const vec3 origin = piece.bounds().lower + vec3{margin, margin, margin};
  const double clearance = options.clearance * piece.uniform_size();
  const double jitter = options.jitter * piece.uniform_size();
  std::uint64_t places = 0;
  for (std::size_t n = 0; n < tree.leaf_count(); ++n) {
    const std::size_t leaf = tree.leaf(n);
    if (piece.is_outside(leaf))
      continue;
    const auto shares_clear_space = [&](vec3 p) {
      return !points.empty() && distance(points.back(), p) < 2 * clearance;
    };
    for_each_lattice_place(tree.box(leaf), origin, options.cell * piece.uniform_size(), [&](vec3 place) {
      const vec3 p = place + jitter * scattered_vector(places++);
      if (piece.is_clear(leaf, p, clearance) && (shares_clear_space(p) || piece.is_inside(leaf, p)))
        points.push_back(p);
    });
  }
  return points;
}

} // namespace dovetail::detail
