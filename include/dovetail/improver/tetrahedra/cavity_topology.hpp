/// @file
/// What has to be checked before a cavity is filled in a mesh that may overlap itself, because elements are
/// (or were) flat or inverted. Where all elements are positive, geometry sees to it.
#pragma once

#include "dovetail/improver/tetrahedra/tet_walks.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace dovetail::improvement {

inline constexpr int max_cavity = 128; ///< elements that a change takes out or puts in, at most

namespace detail {

using side_key = std::array<local_id, 3>;
using side_list = bounded_list<side_key, 4 * max_cavity>;

/// All sides of the elements, with repetitions, sorted.
template <class Elements>
side_list sorted_sides(const Elements& elements) {
  side_list sides;
  for (const simplex<3>& v : elements)
    for (int side = 0; side < 4; ++side)
      sides.push(sorted_side(v, side));
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Some fixed side has elements of the set on both its sides.
inline bool has_fixed_side_within(const tet_complex& mesh, std::span<const local_id> elements) {
  for (const local_id e : elements)
    for (int side = 0; side < 4; ++side)
      if (mesh.is_fixed(e, side) && mesh.across(e, side) != no_id &&
          std::find(elements.begin(), elements.end(), element_of(mesh.across(e, side))) != elements.end())
        return true;
  return false;
}

} // namespace detail

/// The elements `old` are a ball without fixed sides in it, `fresh` fill the same ball, name no vertex twice,
/// and their inner sides are new to the mesh. Otherwise elements at a vertex could fall into groups that are
/// not neighbours, or three elements could meet at a side.
bool fills_a_ball(const tet_complex& mesh, std::span<const local_id> old, std::span<const simplex<3>> fresh);

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/tetrahedra/cavity_topology.ipp"
#endif
