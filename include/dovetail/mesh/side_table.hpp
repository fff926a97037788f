/// @file
/// The sides of a mesh and their elements, as data; `adjacency.hpp` finds them.
#pragma once

#include "dovetail/mesh/simplex.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

/// The unique sides of a mesh, in lexicographic order of their sorted vertices.
template <int D>
struct side_table {
  /// Vertices of each side, oriented outwards of its first element.
  std::vector<simplex<D - 1>> vertices;
  /// The first two elements at each side, the smaller index first; {e, no_id} on the boundary.
  std::vector<std::array<local_id, 2>> elements;
  /// Side of each (element, local side).
  std::vector<std::array<local_id, D + 1>> of_element;
  /// The third and further elements at non-manifold sides: (side, element), sorted. Usually empty.
  std::vector<std::pair<local_id, local_id>> further_elements;

  std::size_t size() const { return elements.size(); }
  /// Whether it has one element only.
  bool is_boundary(local_id side) const { return elements[side][1] == no_id; }
  /// More than two elements meet at the side.
  bool is_non_manifold(local_id side) const {
    if (further_elements.empty())
      return false;
    const auto found =
        std::lower_bound(further_elements.begin(), further_elements.end(), std::pair(side, local_id{0}));
    return found != further_elements.end() && found->first == side;
  }
  /// Exactly two elements meet at the side: the only sides that an element neighbour lies across.
  bool is_interior(local_id side) const { return !is_boundary(side) && !is_non_manifold(side); }
  /// The element across an interior side of `element`; no_id across any other side.
  local_id across(local_id side, local_id element) const {
    if (is_non_manifold(side))
      return no_id;
    const auto& pair = elements[side]; // {element, no_id} on the boundary
    return pair[0] == element ? pair[1] : pair[0];
  }
  /// All elements at a side.
  std::vector<local_id> all_elements(local_id side) const;
};

template <int D>
std::vector<local_id> side_table<D>::all_elements(local_id side) const {
  const auto& pair = elements[side];
  std::vector<local_id> all{pair[0]};
  if (pair[1] != no_id)
    all.push_back(pair[1]);
  for (auto it =
           std::lower_bound(further_elements.begin(), further_elements.end(), std::pair(side, local_id{0}));
       it != further_elements.end() && it->first == side; ++it)
    all.push_back(it->second);
  return all;
}

} // namespace dovetail
