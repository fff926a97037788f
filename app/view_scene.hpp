/// @file
/// What is seen of a mesh: the sides of its pieces, and the elements behind them.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dovetail::app {

/// What can be told apart by colours: names, and the index of one of them for each of some things.
struct view_labels {
  std::vector<std::string> names;
  std::vector<local_id> of;
};

/// An edge of the outline: where the surface ends, turns, or has another group.
struct outline_edge {
  std::array<local_id, 2> ends;
  local_id piece;
};

/// A mesh as pictures and pages show it. Pieces are the subdomains of the file, else its materials; of
/// triangles the groups.
struct view_scene {
  int dimension = 3;         ///< of the elements
  bool second_order = false; ///< of the file's elements: only the corners are here
  std::vector<vec3> points;
  /// All of the mesh, or some: the first of the elements that what is said per element is of. The others are
  /// those behind the triangles. None of a mesh of triangles, which are all in `triangles`.
  std::vector<simplex<3>> tetrahedra;
  std::vector<float> angles; ///< per element: the least one between its sides, in degrees
  view_labels pieces;        ///< per element
  view_labels materials;     ///< per element
  /// First the outer sides. Then, once for each element at it and outwards of that one, what is between
  /// pieces or materials or has a group.
  std::vector<simplex<2>> triangles;
  std::vector<local_id> element_of; ///< per triangle
  view_labels groups;               ///< per triangle: that of the file; without one by material or place
  std::size_t outer = 0;            ///< how many of the triangles are on the outside
  std::vector<outline_edge> outline;
  std::vector<vec3> centres; ///< per piece: the middle of its triangles
  std::size_t count = 0;     ///< of the elements of the mesh
  std::size_t vertices = 0;  ///< of these
  float least_angle = 180;   ///< of these
  box3 box;

  /// How many elements there are that the scene does not have.
  std::size_t elements_elsewhere() const {
    return dimension == 3 && count > tetrahedra.size() ? count - tetrahedra.size() : 0;
  }
  local_id piece_of_triangle(std::size_t t) const { return pieces.of[element_of[t]]; }
};

/// The least angle between the sides of an element, in degrees; 0 where coordinates are too large to compute
/// it.
template <std::size_t N>
float least_angle_of(const std::array<vec3, N>& corners) {
  const auto angle = static_cast<float>(extreme_dihedral_angles(corners)[0]);
  return angle > 0 ? angle : 0;
}

/// Takes the corners of the tetrahedra, or of the triangles where there are none. O(n log n) in time. Throws
/// `mesh_error` where an element names a point that there is not.
view_scene scene_of(io::loaded_mesh loaded);

/// Outline and centres of a scene that has all else.
void finish_scene(view_scene& scene);

/// The triangles and elements of a scene that a page has.
struct view_part {
  std::vector<local_id> triangles;
  std::vector<local_id> elements; ///< the worst first, where not all are here; none of a mesh of triangles

  /// How many of `count` elements are the worst ones, of a part that does not have all.
  static constexpr std::size_t worst_of(std::size_t count) { return (count + 1) / 2; }
};

/// How much of a mesh there is on a page.
struct view_room {
  std::size_t outer;    ///< triangles outside
  std::size_t inner;    ///< triangles between pieces
  std::size_t elements; ///< inside

  /// Of as many as there are; `most` triangles, where an element counts four. What is outside comes first.
  /// Elements have at least a quarter of the rest, since nothing else shows the worst ones.
  view_room(std::size_t all_outer, std::size_t all_inner, std::size_t all_elements, std::int64_t most);
};

/// Adds `count` of some things, evenly spread, or all.
template <class T>
void add_spread(std::vector<T>& to, std::span<const T> from, std::size_t count) {
  count = std::min(count, from.size());
  for (std::size_t k = 0; k < count; ++k)
    to.push_back(from[static_cast<std::size_t>(static_cast<double>(k) * static_cast<double>(from.size()) /
                                               static_cast<double>(count))]);
}

/// As much as there is room for. Of triangles that do not fit there are evenly spread ones; of the elements
/// half are the worst ones, and the others every n-th of the rest.
view_part part_that_fits(const view_scene& scene, std::int64_t most);

/// What a part lacks of the scene, in words; empty: nothing.
std::string text_of_left_out(const view_scene& scene, const view_part& part);

/// Under which angle no element is left out, in degrees; nothing where none is at all.
std::optional<float> complete_under(const view_scene& scene, const view_part& part);

} // namespace dovetail::app
