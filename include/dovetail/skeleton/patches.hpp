/// @file
/// From coarse regions and interface faces, and the remeshed lines around them, to the patches that are
/// remeshed.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/triangle_surface.hpp"
#include "dovetail/skeleton/fine_lines.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// A patch, with the line that each of its segments belongs to (no_id at a pole).
struct skeleton_patch {
  patch_boundary boundary;               ///< its loops
  std::vector<local_id> line_of_segment; ///< by segment of the boundary
};

/// The patch of a region: its lines, passed with the region on the left in the face's parameter plane, and
/// poles.
skeleton_patch region_patch(const any_geometry& model, const surface_mesh& surface,
                            const skeleton_region& region, const numbered_lines& lines);

/// The corners of an interface face in the order of its key, so that every subdomain meshes the same patch.
simplex<2> key_order(const skeleton_face& face);

/// An interface face as a patch: the straight triangle, with the edges that lie on the CAD surface curved.
struct interface_face_patch {
  remesh::triangle_surface surface; ///< the curved triangle
  skeleton_patch patch;             ///< its boundary
};

/// The lines of an interface face: of each side of its key order, from corner i + 1 to corner i + 2.
std::array<local_id, 3> lines_of(const skeleton_face& face, const std::vector<skeleton_line>& lines);

/// The lines of all interface faces. O(n log n).
std::vector<std::array<local_id, 3>> lines_of_faces(const coarse_skeleton& skeleton);

/// The interface faces at each line, growing. Linear.
/// \param lines_of_face the three lines of each face
/// \param lines how many there are
compressed_rows<local_id> faces_of_lines(std::span<const std::array<local_id, 3>> lines_of_face,
                                         std::size_t lines);

/// The boundary of an interface face by labels alone: its points are a function of its corners and lines.
patch_boundary interface_outline(const skeleton_face& face, const std::array<local_id, 3>& lines_of_face,
                                 const numbered_lines& lines);

/// Builds the patch of an interface face.
interface_face_patch interface_patch(const skeleton_face& face, std::span<const vec3> coarse_points,
                                     const numbered_lines& lines);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/patches.ipp"
#endif
