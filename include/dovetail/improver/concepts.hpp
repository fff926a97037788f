/// @file
/// What the pipeline asks of an improver, and what an improver may not touch.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <concepts>
#include <vector>

namespace dovetail {

struct surface_host;

/// What an improver promises; declared by each model.
struct improver_traits {
  bool thread_safe = false; ///< may run in several threads of one process
};

/// What an improver may not touch. Points [0, points) are frozen in place; the sides listed must stay (the
/// boundary of the mesh, where an element has no neighbour, is frozen in any case, with its points).
template <int D>
struct frozen_entities {
  local_id points = 0;                    ///< the first so many points never move
  std::vector<simplex<D - 1>> sides = {}; ///< inner sides that must stay: interfaces, material faces
};

/// The role `improver<I, D>`: better element shapes, frozen entities untouched.
///
/// Valid expressions for `const I& i`, `simplicial_mesh<D>& mesh`, `const frozen_entities<D>& frozen`,
/// `const any_sizing& h` (may be empty: edge lengths are then kept near their present ones):
///
/// - `i(mesh, frozen, h)`: report
/// - `I::traits`: improver_traits, constexpr static
///
/// Semantics: every frozen side is a side of the result; frozen points keep index and coordinates bit for
/// bit, others may be renumbered, removed or added after them; the mesh stays valid, its worst element does
/// not get worse, and elements keep tags. Deterministic: stops by counts, never by time. The traits are true.
///
/// Complexity: linear in the elements per pass, and the number of passes is bounded by a parameter.
///
/// Failure: throws `mesh_error` when the input is not a valid mesh.
///
/// Models: native_improver, no_improver for D = 2 and 3; for D = 3 also improvement::gmsh, netgen and cgal,
/// which give the mesh back as it was when their library made it worse.
template <class I, int D>
concept improver = std::copy_constructible<I> &&
    requires(const I& i, simplicial_mesh<D>& mesh, const frozen_entities<D>& frozen, const any_sizing& h) {
  { i(mesh, frozen, h) } -> std::same_as<report>;
  { I::traits } -> std::convertible_to<improver_traits>;
};

/// The role `surface_improver<I>`: an improver of triangles that knows the surface they lie on.
///
/// Valid expressions: those of `improver<I, 2>` and, for `const surface_host& host` (may be empty: the
/// triangles themselves are then the surface):
///
/// - `i(mesh, frozen, h, host)`: report
///
/// Semantics: vertices that it moves or adds lie on `host`, and no triangle turns over against it. An
/// improver of triangles that is no surface improver moves no vertex of a piece with a curved face (see
/// `improve_on_host`).
///
/// Complexity: as `improver`, with a few calls of the host per vertex moved.
///
/// Failure: as `improver`.
///
/// Models: native_improver, any_improver<2>.
template <class I>
concept surface_improver = improver<I, 2> &&
    requires(const I& i, simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen, const any_sizing& h,
             const surface_host& host) {
  { i(mesh, frozen, h, host) } -> std::same_as<report>;
};

} // namespace dovetail
