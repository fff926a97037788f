/// @file
/// Finds the skeleton of a decomposition of a background mesh.
///
/// `extract_skeleton(surface, pieces)` serves D = 2, where pieces are parts of a surface; with a volume
/// decomposition the same code runs with the pieces that the subdomains induce on the surface: one
/// idea for every dimension. The interface faces and the lines inside the domain are added.
///
/// All throw `mesh_error` when `require_valid` refuses a mesh, unless it is known to be valid, and
/// `usage_error` when there is not one subdomain per element.
#pragma once

#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/mesh/require_valid.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace dovetail {

/// Per surface triangle: the subdomain behind it and the one in front of it, or no_id.
using triangle_subdomains = std::vector<std::array<local_id, 2>>;

/// The interface faces of a volume decomposition: sides inside one material between two subdomains.
/// About linear. Throws `mesh_error` when `require_valid` refuses the volume, `usage_error` when there is not
/// one subdomain per element.
/// \param mesh the background mesh: surface and volume
/// \param sides `build_sides` of the volume
/// \param subdomain_of_element per element of the volume its subdomain, from 0
/// \param mesh_is `mesh_state::valid` skips the checks of a mesh known to be valid
std::vector<skeleton_face> interface_faces(const background_mesh& mesh, const side_table<3>& sides,
                                           const std::vector<local_id>& subdomain_of_element,
                                           mesh_state mesh_is = mesh_state::unknown);

/// Per surface triangle: the element behind it and the one in front of it, or no_id.
using elements_at_triangles = std::vector<std::array<local_id, 2>>;

/// The elements of the volume at each surface triangle. Throws `mesh_error` when one is not a side of the
/// volume.
elements_at_triangles elements_beside_surface(const background_mesh& mesh, const side_table<3>& sides);

/// The pieces that the subdomains of a volume induce on its surface.
triangle_subdomains induced_subdomains(const elements_at_triangles& beside,
                                       const std::vector<local_id>& subdomain_of_element);

/// The pieces of a surface that is itself decomposed (D = 2): the part of each triangle, nothing in front.
/// Linear. Throws nothing.
/// \param part_of_triangle per triangle its part, from 0
triangle_subdomains own_subdomains(const std::vector<local_id>& part_of_triangle);

/// The skeleton of a surface cut into pieces; `faces` are the interface faces that end on it (none for D =
/// 2). O(n log n). Throws `mesh_error` when the surface mesh contradicts itself.
/// \param surface the coarse surface with its CAD faces and curves
/// \param pieces per triangle the subdomains behind it and in front of it, or `no_id`
/// \param faces interface faces, from `interface_faces`
/// \param mesh_is `mesh_state::valid` skips the checks of a mesh known to be valid
coarse_skeleton extract_skeleton(const surface_mesh& surface, const triangle_subdomains& pieces,
                                 std::vector<skeleton_face> faces = {},
                                 mesh_state mesh_is = mesh_state::unknown);

/// The skeleton of a volume decomposition: interface faces first, then the surface step with the induced
/// pieces.
/// \param mesh the background mesh: surface and volume
/// \param sides `build_sides` of the volume
/// \param subdomain_of_element per element of the volume its subdomain, from 0
coarse_skeleton extract_skeleton(const background_mesh& mesh, const side_table<3>& sides,
                                 const std::vector<local_id>& subdomain_of_element,
                                 mesh_state mesh_is = mesh_state::unknown);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/extract_skeleton.ipp"
#endif
