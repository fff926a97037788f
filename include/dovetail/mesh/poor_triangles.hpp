/// @file
/// Why triangles of a mesh of D = 2 have small angles: what of the model, of the decomposition or of the
/// mesher it is.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/poor_elements.hpp"

#include <span>
#include <string_view>

namespace dovetail {

inline constexpr int bad_corner_deg = 15; ///< a triangle with a smaller angle is bad
inline constexpr int low_corner_deg = 30; ///< one with a smaller angle is of low quality

/// A few words for triangles, such as "narrow face".
std::string_view name_of_triangles(poor_cause cause);

/// Finds the triangles of a piece that are of low quality, and the cause of each, the first of these that
/// holds: `model_angle`, it is in an angle between two curves of its face, under twice the limit, or between
/// two curves that meet somewhere at less than 30 degrees; `interface_angle`, in one between two lines of
/// which one at least is no curve of the model; `thin_wall`, a face is narrow there: each of its vertices is
/// on a curve of the model, or inside and joined to two at most that are not; `thin_piece`, each is on the
/// boundary of its piece; else `inside`. `thinnest_wall` is the least height of the bad ones of narrow faces.
/// Linear, and n log n in the corners beside such triangles.
/// Throws nothing but for a lack of memory.
/// \param piece as `check_piece` finds it right; elements of different tags are of different faces
/// \param skeleton that of its mesh
/// \param listed the numbers of the skeleton's sides at this piece: `io::sides_by_subdomain`
poor_elements find_poor_elements(const simplicial_piece<2>& piece, const simplicial_skeleton<2>& skeleton,
                                 std::span<const local_id> listed);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/poor_triangles.ipp"
#endif
