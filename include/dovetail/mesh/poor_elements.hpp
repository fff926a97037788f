/// @file
/// Why tetrahedra have small dihedral angles: what of the model, of the decomposition or of the mesher it is.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace dovetail {

inline constexpr int bad_dihedral_deg = 12; ///< a tetrahedron with a smaller dihedral angle is bad
inline constexpr int low_dihedral_deg = 24; ///< one with a smaller dihedral angle is of low quality

/// Why a tetrahedron is of low quality: the first of these that holds.
enum class poor_cause : std::uint8_t {
  model_angle, ///< it is in an angle of the model (of faces, of curves) under twice the limit, or beside it
  interface_angle,   ///< it is in such an angle of an interface with another one or the surface
  boundary_triangle, ///< a side of it is a boundary triangle with an angle below the limit
  thin_wall,         ///< each of its vertices is on the model's surface, or joined to few that are not
  thin_piece,        ///< all its vertices are on the boundary of its piece
  inside             ///< none of these: the mesher and the improver left it
};

/// How many causes there are.
inline constexpr std::size_t poor_causes = 6;

/// A few words, such as "thin wall".
std::string_view name_of(poor_cause cause);

/// Tetrahedra of low quality by their causes.
struct poor_elements {
  std::array<std::int64_t, poor_causes> bad{}; ///< under `bad_dihedral_deg`, by `poor_cause`
  std::array<std::int64_t, poor_causes> low{}; ///< under `low_dihedral_deg`, the bad ones too
  double thinnest_wall = std::numeric_limits<double>::infinity(); ///< least height of those across walls
  vec3 thinnest_place{};                                          ///< where that is

  /// The bad ones of one cause.
  std::int64_t bad_by(poor_cause cause) const { return bad[static_cast<std::size_t>(cause)]; }
  /// Those of low quality of one cause, the bad ones too.
  std::int64_t low_by(poor_cause cause) const { return low[static_cast<std::size_t>(cause)]; }
  /// Adds those of another piece. The result does not depend on the order.
  void merge(const poor_elements& other);

  using fields = field_list<&poor_elements::bad, &poor_elements::low, &poor_elements::thinnest_wall,
                            &poor_elements::thinnest_place>;
};

/// Finds the tetrahedra of a piece that are of low quality, and the cause of each. Linear, and n log n in the
/// boundary's triangles where there are such tetrahedra.
/// Throws nothing but for a lack of memory.
/// \param piece as `check_piece` finds it right
/// \param skeleton that of its mesh
/// \param listed the numbers of the skeleton's sides at this piece: `io::sides_by_subdomain`
poor_elements find_poor_elements(const mesh_piece& piece, const fine_skeleton& skeleton,
                                 std::span<const local_id> listed);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/poor_elements.ipp"
#endif
