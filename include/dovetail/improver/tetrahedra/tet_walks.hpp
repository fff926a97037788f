/// @file
/// The elements around an edge (its shell) and around a vertex (its star).
#pragma once

#include "dovetail/improver/tetrahedra/tet_complex.hpp"

#include <array>

namespace dovetail::improvement {

/// An array of fixed capacity that reports overflow instead of growing; no allocation.
template <class T, int Capacity>
struct bounded_list {
  std::array<T, static_cast<std::size_t>(Capacity)> items; ///< the first `size` of them are in use
  int size = 0;

  /// Puts an item at the end; false when there is no room.
  bool push(T item) {
    if (size == Capacity)
      return false;
    items[size++] = item;
    return true;
  }
  T& operator[](int i) { return items[i]; }
  const T& operator[](int i) const { return items[i]; }
  auto begin() const { return items.begin(); }
  auto end() const { return items.begin() + size; }
  auto begin() { return items.begin(); }
  auto end() { return items.begin() + size; }
  /// The items in use.
  std::span<const T> view() const { return {items.data(), static_cast<std::size_t>(size)}; }
};

/// For each edge of an element its two corners, then the other two, in an order of even parity.
inline constexpr std::array<std::array<int, 4>, 6> edge_corners{
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

inline constexpr int max_shell = 12; ///< elements around an edge, at most
inline constexpr int max_star = 96;  ///< elements at a vertex, at most

/// A closed shell: element i is (a, b, ring[i], ring[i+1]), positively oriented like the elements are.
struct edge_shell {
  local_id a = no_id, b = no_id; ///< the vertices of the edge
  /// The other vertices of the elements, and the elements, in order around the edge.
  bounded_list<local_id, max_shell> ring, elements;
};

/// Collects the shell of edge `edge` of `e`. False when the shell passes a fixed side (the edge may then not
/// be removed) or has more than `max_shell` elements.
inline bool collect_shell(const tet_complex& mesh, local_id e, int edge, edge_shell& shell) {
  const auto& corners = edge_corners[edge];
  shell.a = mesh.vertex(e, corners[0]);
  shell.b = mesh.vertex(e, corners[1]);
  shell.ring.size = shell.elements.size = 0;
  int behind = corners[2];
  local_id ahead = mesh.vertex(e, corners[3]);
  local_id current = e;
  do {
    if (mesh.is_fixed(current, behind))
      return false;
    if (!shell.ring.push(mesh.vertex(current, behind)) || !shell.elements.push(current))
      return false;
    const half_side beyond = mesh.across(current, behind);
    current = element_of(beyond);
    behind = mesh.corner_of(current, ahead);
    ahead = mesh.vertex(current, side_of(beyond));
  } while (current != e);
  return true;
}

/// The elements that have `v`, in an order that depends on the mesh only. Marks them. Does not pass fixed
/// sides, so it is the whole star of a free vertex. False when there are more than `max_star`.
inline bool collect_star(tet_complex& mesh, local_id v, bounded_list<local_id, max_star>& star) {
  star.size = 0;
  mesh.clear_marks();
  const local_id first = mesh.element_at(v);
  mesh.mark(first);
  star.push(first);
  for (int i = 0; i < star.size; ++i) {
    const local_id e = star[i];
    for (int side = 0; side < 4; ++side) {
      if (mesh.vertex(e, side) == v || mesh.is_fixed(e, side))
        continue;
      const local_id other = element_of(mesh.across(e, side));
      if (mesh.is_marked(other))
        continue;
      mesh.mark(other);
      if (!star.push(other))
        return false;
    }
  }
  return true;
}

} // namespace dovetail::improvement
