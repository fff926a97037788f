/// @file
/// What is asked of a mesher of one region of a surface.
#pragma once

#include "dovetail/remesh/surfaces.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <concepts>

namespace dovetail {

/// The role `surface_mesher`: fill frozen loops in the parameter plane of a surface with triangles. (By
/// `mesher::by_regions` also the pieces of D = 2.)
///
/// Valid expression for `const M& m`, `const any_surface& s`, `const patch_boundary& b`,
/// `const any_sizing& h`:
///
/// - `m(s, b, h)`: patch_mesh
///
/// Semantics: each segment of `b` is a side of exactly one triangle, on its left (two for a slit, which is
/// listed in both directions); a pole's segments, whose ends have one label, are sides of none. New points
/// lie exactly on the surface at their parameters. Triangles are counter-clockwise in the parameter plane and
/// cover the domain once. The mean edge length on a uniform field equals the size within 10 % where the
/// parameters are isometric up to constant factors. The same arguments give the same mesh. Forbidden edges
/// may be ignored: `mesh_region` splits them.
///
/// Complexity: n log n in the triangles made or better.
///
/// Failure: loops that cross or run backwards are data (`crossings`, `misplaced`; no triangles then). Throws
/// `mesher_error` when a library fails, `sizing_error` for an unusable size, and what the surface throws.
///
/// A model that may not run in several threads of one process says so by `static constexpr bool thread_safe =
/// false`.
///
/// Models: patch_remesher (also keeps clear of forbidden edges), cgal_delaunay, gmsh_frontal,
/// any_surface_mesher. `mesher::by_regions` makes native_surface, cgal_surface and gmsh_surface of them.
template <class M>
concept surface_mesher = std::copy_constructible<M> &&
    requires(const M& m, const any_surface& s, const patch_boundary& b, const any_sizing& h) {
  { m(s, b, h) } -> std::same_as<patch_mesh>;
};

/// Whether a policy has not said that it may not run in several threads of one process.
template <class M>
constexpr bool is_thread_safe() {
  if constexpr (requires { M::thread_safe; })
    return M::thread_safe;
  else
    return true;
}

/// Whether its type alone says that it may not: one that may hold another says it when the program runs.
template <class M>
constexpr bool never_runs_in_threads() {
  return !is_thread_safe<M>() && !requires(const M& mesher) {
    mesher.may_run_in_threads();
  };
}

/// Whether this one may, which may hold another behind one type.
template <class M>
bool may_run_in_threads(const M& mesher) {
  if constexpr (requires {
                  { mesher.may_run_in_threads() } -> std::same_as<bool>;
                })
    return mesher.may_run_in_threads();
  else
    return is_thread_safe<M>();
}

} // namespace dovetail
