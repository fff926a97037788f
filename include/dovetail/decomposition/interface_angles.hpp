/// @file
/// The interface angles: no small face angle on an interface, no small dihedral beside one. Measured in a
/// mesh that is cut into parts, or on the fine skeleton between them; what is too small is listed with its
/// cause.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/decomposition/angle_types.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/mesh/side_state.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/mesh/wanted_angles.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace dovetail {

/// A mesh cut into parts. Without `side_states` what bounds the mesh is fixed, and where the tag changes.
template <int D>
struct decomposed_mesh {
  const simplicial_mesh<D>& mesh; ///< it must outlive this
  const side_table<D>& sides;     ///< `build_sides(mesh)`
  std::span<const side_state> side_states;
  std::span<const local_id> part_of_element; ///< a part for each element
  /// Of fine lines (D = 2): the direction in which the line along a side leaves a vertex; empty where
  /// interfaces are as the mesh has them.
  std::function<vec3(local_id side, local_id vertex)> leaves = {};
  mesh_state mesh_is = mesh_state::unknown; ///< `valid`: `require_valid` has seen it
};

/// One of so many shares, about equal, of what there is to measure: triangles that follow each other, and the
/// edges of which the smaller point leaves the share's number as its remainder.
struct angle_share {
  std::size_t number = 0; ///< from 0
  std::size_t of = 1;     ///< how many there are
};

/// The interface angles of a mesh of triangles (D = 2) or tetrahedra (D = 3), with or without CAD: at each
/// ridge those of the elements between two sides that are fixed or interfaces add up to a dihedral. One
/// between fixed sides that themselves include less than is wanted is forced. `sides` in the result are sides
/// of the mesh. Linear in the mesh. Throws `mesh_error` when `require_valid` refuses the mesh, and
/// `usage_error` when there is not one part per element, or one state per side where there are any.
///
///     auto angles = measure_interface_angles<2>({mesh, sides, simplified.side_states, part_of_element},
///                                               wanted_angles_of<2>(rule));
/// \param given the mesh, its sides and their states, and per element its part
/// \param wanted the angles below which one is a violation, in degrees
template <int D>
interface_angles measure_interface_angles(const decomposed_mesh<D>& given, const wanted_angles& wanted);

/// The interface angles of a fine skeleton: between triangles, around their edges; those on CAD faces and on
/// the boundary are fixed. `refused`: not zero for triangles on a coarse side that the bound refused to
/// remove; may be empty. `half_edges`: only the dihedrals at these edges are measured, given as 3 t + k for
/// side k of triangle t, all of an edge or none; all when none are given. `sides` in the result are
/// triangles. About linear. Throws `mesh_error` for points that do not exist or are not finite, for a
/// triangle that is flat or there twice, and where the subdomains around an edge contradict each other since
/// a triangle is turned over; not looked for in a skeleton that is `valid`.
/// \param fine the remeshed skeleton
/// \param wanted the angles below which one is a violation, in degrees
/// \param refused one per triangle, or empty
/// \param half_edges those to measure; all of them unless given
/// \param skeleton_is `mesh_state::valid` skips the checks of a skeleton known to be valid
/// \param share which triangles and edges to measure, as one of several tasks; of `half_edges` those of
/// other shares may be left out. Throws `usage_error` where there is no such share
interface_angles measure_skeleton_angles(const fine_skeleton& fine, const wanted_angles& wanted,
                                         std::span<const std::uint8_t> refused = {},
                                         std::optional<std::span<const std::uint32_t>> half_edges = {},
                                         mesh_state skeleton_is = mesh_state::unknown,
                                         angle_share share = {});

/// Half edges by the shares that measure them. Linear.
/// \param fine the remeshed skeleton
/// \param half_edges as for `measure_skeleton_angles`
/// \param shares how many there are to be
compressed_rows<std::uint32_t> half_edges_of_shares(const fine_skeleton& fine,
                                                    std::span<const std::uint32_t> half_edges,
                                                    std::size_t shares);

/// What was measured in all shares, as it is without: least angles that are equal are those of the first
/// triangles and edges. n log n in the violations.
interface_angles joined_shares(std::span<const interface_angles> shares);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/interface_angles.ipp"
#endif
