/// @file
/// A triangulation of the whole plane or space: elements and their neighbours in one flat array.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/triangulation/space.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// The elements of a triangulation of points, closed by ghosts: across each side of the convex hull lies an
/// element whose one vertex is `infinite`, so that every element has a neighbour across every side.
///
/// Data with invariants that the functions which change it keep: living elements are positively oriented
/// (a ghost as if its infinite vertex were far outside), and `across` is mutual: when `across[i]` of element
/// e is side s, then the element of s has e's side i across its side.
template <int D>
struct triangulation {
  static_assert(D == 2 || D == 3);
  static constexpr local_id corners = D + 1; ///< vertices of an element, and its sides
  /// The vertex of ghosts.
  static constexpr local_id infinite = no_id;

  /// An element; one cache line holds two of D = 3.
  struct cell {
    simplex<D> vertices; ///< corners; side i is opposite vertex i
    /// Per side, which is opposite the vertex of the same place: the neighbour's side there, as `side_of`.
    std::array<local_id, static_cast<std::size_t>(D) + 1> across;
  };

  std::vector<point_of<D>> points; ///< by number; ghosts have `infinite` in place of one
  std::vector<cell> cells;         ///< some of them dead: those that `is_alive` denies
  std::vector<local_id> dead;      ///< which these are; they are used again from the back

  /// The number of side `i` of element `e`.
  static constexpr local_id side_of(local_id e, local_id i) { return corners * e + i; }
  /// The element that has a side.
  static constexpr local_id element_of(local_id side) { return side / corners; }
  /// Which side of its element it is.
  static constexpr local_id place_of(local_id side) { return side % corners; }

  const cell& operator[](local_id e) const { return cells[e]; }
  cell& operator[](local_id e) { return cells[e]; }
  const point_of<D>& point(local_id v) const { return points[v]; } ///< where a vertex is
  local_id across(local_id side) const { return (*this)[element_of(side)].across[place_of(side)]; }

  bool is_alive(local_id e) const { return (*this)[e].vertices[0] != dead_mark; }
  /// Of a living element.
  bool is_ghost(local_id e) const {
    local_id any = 0;
    for (const local_id v : (*this)[e].vertices)
      any |= v; // `infinite` is the only negative one
    return any < 0;
  }
  /// The place of the infinite vertex of a ghost.
  std::size_t infinite_place(local_id e) const {
    std::size_t i = 0;
    while ((*this)[e].vertices[i] != infinite)
      ++i;
    return i;
  }
  /// The points of an element that is no ghost.
  corner_places<D> points_of(local_id e) const {
    const auto& v = (*this)[e].vertices;
    const point_of<D>* const at = points.data();
    if constexpr (D == 2)
      return {at + v[0], at + v[1], at + v[2]};
    else
      return {at + v[0], at + v[1], at + v[2], at + v[3]};
  }

  /// Makes two sides each other's neighbour.
  void join(local_id side, local_id other) {
    (*this)[element_of(side)].across[place_of(side)] = other;
    (*this)[element_of(other)].across[place_of(other)] = side;
  }
  /// A place for a new element, whose content is undefined. Throws `geometry_error` when there are so many
  /// that their sides have no numbers.
  local_id add() {
    if (!dead.empty()) {
      const local_id e = dead.back();
      dead.pop_back();
      return e;
    }
    if (cells.size() >= most_cells)
      throw geometry_error("a triangulation of more than " + std::to_string(most_cells) +
                           " elements; divide the points among several");
    cells.emplace_back();
    return static_cast<local_id>(cells.size()) - 1;
  }
  /// Marks an element as dead, to be used again.
  void remove(local_id e) {
    (*this)[e].vertices[0] = dead_mark;
    dead.push_back(e);
  }

private:
  static constexpr local_id dead_mark = -2;
  static constexpr std::size_t most_cells =
      static_cast<std::size_t>(std::numeric_limits<local_id>::max() / corners);
};

} // namespace dovetail
