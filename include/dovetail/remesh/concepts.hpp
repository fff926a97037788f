/// @file
/// What is asked of a mesher of one surface patch.
#pragma once

#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/surfaces.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <concepts>

namespace dovetail {

/// The role `surface_mesher<M, S>`: fill frozen loops in the parameter plane of a surface with triangles.
///
/// Valid expression for `const M& m`, `const S& s`, `const patch_boundary& b`, `const any_sizing& h`:
///
/// - `m(s, b, h)`: patch_mesh
///
/// Semantics: each segment of `b` is a side of exactly one triangle, on its left (two for a slit, which is
/// listed in both directions); a pole's segments, whose ends have one label, are sides of none. New points
/// lie exactly on the surface at their parameters. Triangles are counter-clockwise in the parameter plane and
/// cover the domain once. The mean edge length on a uniform field equals the size within 10 % where the
/// parameters are isometric up to constant factors. The same arguments give the same mesh.
///
/// Complexity: n log n in the triangles made or better.
///
/// Failure: loops that cross or run backwards are data (`crossings`, `misplaced`; no triangles then). Throws
/// `mesher_error` when a library fails, `sizing_error` for an unusable size, and what the surface throws.
///
/// A model that may not run in several threads of one process says so by `static constexpr bool thread_safe =
/// false`.
///
/// Models: patch_remesher (also keeps clear of forbidden edges), cgal_delaunay, gmsh_frontal. A model becomes
/// a mesher of D = 2 pieces by `mesher::by_regions`: native_surface, cgal_surface, gmsh_surface.
template <class M, class S = remesh::plane_surface>
concept surface_mesher = patch_surface<S> && std::copy_constructible<M> &&
    requires(const M& m, const S& s, const patch_boundary& b, const any_sizing& h) {
  { m(s, b, h) } -> std::same_as<patch_mesh>;
};

template <class M>
constexpr bool is_thread_safe() {
  if constexpr (requires { M::thread_safe; })
    return M::thread_safe;
  else
    return true;
}

} // namespace dovetail
