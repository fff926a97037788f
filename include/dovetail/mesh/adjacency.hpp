/// @file
/// Who touches whom in a mesh: unique sides with their elements, element neighbours, and the fans of
/// dihedrals around ridges. Everything is found by sorting; a mesh of 10 million elements takes seconds.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/side_table.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// One dihedral: an element at one of its ridges, passed from side `from` to side `to`.
struct dihedral {
  local_id element;         ///< the element whose dihedral it is
  int ridge;                ///< local ridge of the element
  std::array<int, 2> sides; ///< its local sides, in passing order: {from, to}
};

/// The unique ridges of a mesh, in lexicographic order of their sorted vertices, with their fans.
///
/// A fan is a maximal run of dihedrals around a ridge in which consecutive dihedrals share an interior side.
/// It is closed (cyclic) or open; an open one starts and ends at sides that do not have two elements. On a
/// manifold every ridge has one fan.
template <int D>
struct ridge_table {
  static constexpr std::size_t per_element = numbering::ridges<D>.size(); ///< ridges of an element

  std::vector<simplex<D - 2>> vertices;                      ///< sorted
  std::vector<std::array<local_id, per_element>> of_element; ///< ridge of each (element, local ridge)
  std::vector<std::uint32_t> fan_begins{
      0}; ///< size ridges + 1: fans of ridge r are [fan_begins[r], fan_begins[r+1])
  std::vector<std::uint32_t> dihedral_begins{
      0}; ///< size fans + 1: dihedrals of fan f are the codes in [dihedral_begins[f], ...)
  std::vector<std::uint32_t> dihedral_codes; ///< see `decode`
  std::vector<bool> closed;                  ///< per fan: cyclic?

  std::size_t size() const { return vertices.size(); }
  /// The codes of the dihedrals of a fan, in order around the ridge.
  std::span<const std::uint32_t> fan(std::size_t f) const {
    return std::span(dihedral_codes).subspan(dihedral_begins[f], dihedral_begins[f + 1] - dihedral_begins[f]);
  }
  /// A dihedral in one number: element, which of its ridges, and whether it is passed backwards.
  static constexpr std::uint32_t encode(std::uint32_t element, std::uint32_t ridge, bool flipped) {
    return (element * static_cast<std::uint32_t>(per_element) + ridge) * 2 + (flipped ? 1 : 0);
  }
  static constexpr dihedral decode(std::uint32_t code) {
    const std::uint32_t flat = code / 2;
    const auto ridge = static_cast<int>(flat % per_element);
    std::array<int, 2> sides = numbering::sides_of_ridge<D>[ridge];
    if (code % 2 == 1)
      std::swap(sides[0], sides[1]);
    return {static_cast<local_id>(flat / per_element), ridge, sides};
  }
};

namespace detail {

template <std::size_t N, std::size_t M>
constexpr std::array<local_id, N> pick(const std::array<local_id, M>& vertices,
                                       const std::array<int, N>& which) {
  std::array<local_id, N> picked{};
  for (std::size_t k = 0; k < N; ++k)
    picked[k] = vertices[which[k]];
  return picked;
}

} // namespace detail

/// The vertices of a side as one of its elements passes it: oriented outwards of that element.
template <int D>
simplex<D - 1> side_of_element(const simplicial_mesh<D>& mesh, const side_table<D>& sides, local_id side,
                               local_id element) {
  const auto& of_element = sides.of_element[element];
  const auto local =
      static_cast<std::size_t>(std::find(of_element.begin(), of_element.end(), side) - of_element.begin());
  return detail::pick(mesh.elements[element], numbering::sides<D>[local]);
}

/// Finds the unique sides of `elements`. About linear time. Throws `mesh_error` when an element refers to a
/// point that does not exist.
/// \param elements D + 1 indices of points each
/// \param point_count how many points there are
template <int D>
side_table<D> build_sides(std::span<const simplex<D>> elements, std::size_t point_count);

/// The same for all elements of a mesh.
/// \param mesh triangles (D = 2) or tetrahedra (D = 3)
template <int D>
side_table<D> build_sides(const simplicial_mesh<D>& mesh);

/// The element across each local side, or no_id where the side does not have exactly two elements. Linear.
/// Throws nothing but for a lack of memory.
/// \param sides `build_sides` of the elements
template <int D>
std::vector<std::array<local_id, D + 1>> element_neighbours(const side_table<D>& sides);

/// Finds the unique ridges of `elements` and orders the dihedrals around each into fans. `sides` must be
/// `build_sides` of the same elements. About linear time; quadratic in the number of dihedrals of one ridge.
/// Throws nothing but for a lack of memory.
/// \param elements D + 1 indices of points each
/// \param point_count how many points there are
/// \param sides `build_sides` of the elements
template <int D>
ridge_table<D> build_ridges(std::span<const simplex<D>> elements, std::size_t point_count,
                            const side_table<D>& sides);

/// The same for all elements of a mesh.
/// \param mesh triangles (D = 2) or tetrahedra (D = 3)
template <int D>
ridge_table<D> build_ridges(const simplicial_mesh<D>& mesh, const side_table<D>& sides);

/// Only the ridges all of whose points are wanted, each with all its fans; the others are `no_id` in
/// `of_element`. What is made is as large as what is wanted.
/// \param mesh triangles (D = 2) or tetrahedra (D = 3)
/// \param sides `build_sides` of the elements
/// \param is_wanted not zero for such points, one per point
template <int D>
ridge_table<D> build_ridges_at(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                               std::span<const std::uint8_t> is_wanted);

/// The side with these vertices in any order, or no_id. O(log sides).
/// Throws nothing.
/// \param sides `build_sides` of the elements
/// \param vertices D indices of points
template <int D>
local_id find_side(const side_table<D>& sides, const simplex<D - 1>& vertices);

#ifdef DOVETAIL_COMPILED
extern template side_table<2> build_sides<2>(std::span<const simplex<2>> elements, std::size_t point_count);
extern template side_table<2> build_sides<2>(const simplicial_mesh<2>& mesh);
extern template std::vector<std::array<local_id, 3>> element_neighbours<2>(const side_table<2>& sides);
extern template ridge_table<2> build_ridges<2>(std::span<const simplex<2>> elements, std::size_t point_count,
                                               const side_table<2>& sides);
extern template ridge_table<2> build_ridges<2>(const simplicial_mesh<2>& mesh, const side_table<2>& sides);
extern template ridge_table<2> build_ridges_at<2>(const simplicial_mesh<2>& mesh, const side_table<2>& sides,
                                                  std::span<const std::uint8_t> is_wanted);
extern template local_id find_side<2>(const side_table<2>& sides, const simplex<1>& vertices);
extern template side_table<3> build_sides<3>(std::span<const simplex<3>> elements, std::size_t point_count);
extern template side_table<3> build_sides<3>(const simplicial_mesh<3>& mesh);
extern template std::vector<std::array<local_id, 4>> element_neighbours<3>(const side_table<3>& sides);
extern template ridge_table<3> build_ridges<3>(std::span<const simplex<3>> elements, std::size_t point_count,
                                               const side_table<3>& sides);
extern template ridge_table<3> build_ridges<3>(const simplicial_mesh<3>& mesh, const side_table<3>& sides);
extern template ridge_table<3> build_ridges_at<3>(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                                                  std::span<const std::uint8_t> is_wanted);
extern template local_id find_side<3>(const side_table<3>& sides, const simplex<2>& vertices);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/adjacency.ipp"
#endif
