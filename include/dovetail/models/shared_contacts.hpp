/// @file
/// Do bodies touch each other anywhere but where they share faces, curves and vertices already? Seen on
/// triangles, which a kernel makes in a fraction of the time in which it intersects surfaces.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

namespace dovetail {

/// How close two bodies come where they share nothing, as far as triangles tell: 0 where these cross or meet,
/// or lie on each other at an edge that they share; otherwise no more than their distance; and infinity where
/// that is more than `within` everywhere. Bodies are solids, and faces in none; two such faces are not
/// compared. About O(n log n). Throws nothing but for a lack of memory.
/// \param surface triangles of all faces, which share points exactly where faces share curves and vertices;
/// tags are faces
/// \param topology of the faces: which solids they bound
/// \param within a length
double unshared_distance(const surface_mesh& surface, const geometry_topology& topology, double within);

/// Whether a solid has another body inside, of bodies that touch nowhere but where they share topology.
/// Throws `geometry_error` when the triangles around a solid are not closed. \param surface as above \param
/// topology as above
bool has_body_inside_another(const surface_mesh& surface, const geometry_topology& topology);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/shared_contacts.ipp"
#endif
