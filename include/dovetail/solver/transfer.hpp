/// @file
/// Fields from one mesh to another of the same domain: a solution is kept when the mesh is adapted.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <span>
#include <vector>

namespace dovetail {

/// A field that is linear in the elements of `from`, at the points `to`; beside the mesh it has the value of
/// the nearest point of it. `values` has `components` numbers for each point of `from`, one after the other,
/// and so has the result for each of `to`. O(n log n + m log n). Throws `mesh_error` for a mesh without
/// elements or with one that names no point, for a point or a value that is not finite, and for another
/// number of values.
///
///     const auto next = whole_mesh(adapt<3>(model, mesh, sizes, policies));
///     u = transferred_to_points<3>(mesh.mesh, u, next.mesh.points);
/// \param from the mesh that the field is on
/// \param values `components` per point of `from`
/// \param to the places where the field is wanted
/// \param components numbers per point, 1 for a scalar
template <int D>
std::vector<double> transferred_to_points(const simplicial_mesh<D>& from, std::span<const double> values,
                                          std::span<const vec3> to, int components = 1);

/// A field that is constant in each element of `from`, as means over the elements of `to`. What each element
/// had, its value times its volume (D = 2: area), is divided among those that it overlaps, by volume: the
/// integral over the whole is kept to rounding; a positive value stays positive, and, for the same
/// domain, a constant field constant. Where the boundary has moved, what is not covered counts as covered by
/// the nearest element: values there are off by as much as the volume changed.
///
/// With tags in both meshes only elements of the same tag share, and what a tag had stays in it, as long as
/// both meshes have the tag. For D = 2 on a curved surface overlaps are those of triangles projected to the
/// new one's plane.
///
/// `values` has `components` numbers for each element, one after the other, and so has the result. O(n log n)
/// and linear in the overlaps. Throws as `transferred_to_points`, and for an element of `to` without volume.
/// \param from the mesh that the field is on
/// \param values `components` per element of `from`
/// \param to the mesh that the field is wanted on
/// \param components numbers per element, 1 for a scalar
template <int D>
std::vector<double> transferred_to_elements(const simplicial_mesh<D>& from, std::span<const double> values,
                                            const simplicial_mesh<D>& to, int components = 1);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/transfer.ipp"
#endif
