/// @file
/// The check at the entry of stages that are called alone: what a mesh has to be so that they measure what is
/// there. Where `check_validity` counts all that is wrong, this ends at the first fault, and needs no sort.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/validity.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace dovetail {

/// What a stage knows of the mesh that it is given.
enum class mesh_state {
  unknown, ///< `require_valid` is asked
  valid    ///< it was asked before: not again
};

/// What a stage asks of a mesh beyond indices in range, finite points and elements that are there once.
struct mesh_demands {
  /// Elements are positive (D = 3) or not flat (D = 2), and those at a side lie on its two sides.
  bool orientation = true;
};

namespace detail {

[[noreturn]] void refuse_mesh(std::string_view who, const std::string& why);

template <std::size_t N>
std::string listed_points(const std::array<local_id, N>& vertices) {
  std::string text;
  for (const local_id v : vertices)
    text += (text.empty() ? "" : ", ") + std::to_string(v);
  return text;
}

inline bool is_finite(vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void require_finite(std::span<const vec3> points, std::string_view who);

/// What can be said of each element by itself.
template <int D>
void require_elements(const simplicial_mesh<D>& mesh, std::string_view who, const mesh_demands& demands);

} // namespace detail

/// Throws `mesh_error` that names the element or point, its numbers and what to do about it, unless indices
/// are in range, all points finite and all elements different; none is inverted or flat, exactly; and at each
/// side no more than two elements (D = 3), which lie on its two sides. In D = 2 the orientation has to be the
/// same across sides with two elements of one tag, and more elements may meet at a side. `sides` is
/// `build_sides(mesh)`, which is looked at too. `who` is what the message begins with. Linear; about 0.05 us
/// per element, and 0.1 us more where the sides have to be found.
/// \param mesh triangles or tetrahedra
/// \param sides of this mesh
/// \param who such as "the background mesh"
/// \param demands whether orientation is looked at
template <int D>
void require_valid(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                   std::string_view who = "the mesh", const mesh_demands& demands = {});
template <int D>
void require_valid(const simplicial_mesh<D>& mesh, std::string_view who = "the mesh",
                   const mesh_demands& demands = {});

namespace detail {

/// At the entry of a stage.
template <int D>
void require_valid_unless(mesh_state state, const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                          std::string_view who) {
  if (state == mesh_state::unknown)
    require_valid(mesh, sides, who);
}

/// Throws `usage_error` unless there is one number per element, in [0, end).
void require_one_per_element(std::span<const local_id> numbers, std::size_t elements, local_id end,
                             std::string_view who, std::string_view what);

#ifdef DOVETAIL_COMPILED
extern template void require_elements<2>(const simplicial_mesh<2>& mesh, std::string_view who,
                                         const mesh_demands& demands);
extern template void require_elements<3>(const simplicial_mesh<3>& mesh, std::string_view who,
                                         const mesh_demands& demands);
#endif

} // namespace detail
#ifdef DOVETAIL_COMPILED
extern template void require_valid<2>(const simplicial_mesh<2>& mesh, const side_table<2>& sides,
                                      std::string_view who, const mesh_demands& demands);
extern template void require_valid<2>(const simplicial_mesh<2>& mesh, std::string_view who,
                                      const mesh_demands& demands);
extern template void require_valid<3>(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                                      std::string_view who, const mesh_demands& demands);
extern template void require_valid<3>(const simplicial_mesh<3>& mesh, std::string_view who,
                                      const mesh_demands& demands);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/require_valid.ipp"
#endif
