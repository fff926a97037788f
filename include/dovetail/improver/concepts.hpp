/// @file
/// What the pipeline asks of an improver, and what an improver may not touch.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <concepts>
#include <vector>

namespace dovetail {

/// What an improver may not touch. Points [0, points) are frozen in place; the sides listed must stay (the
/// boundary of the mesh, where an element has no neighbour, is frozen in any case, with its points).
template <int D>
struct frozen_entities {
  local_id points = 0;                    ///< the first so many points never move
  std::vector<simplex<D - 1>> sides = {}; ///< inner sides that must stay: interfaces, material faces
};

/// The role `improver<I, D>`: better element shapes, frozen entities untouched.
///
/// Valid expression for `const I& i`, `simplicial_mesh<D>& mesh`, `const frozen_entities<D>& frozen`,
/// `const any_sizing& h` (may be empty: edge lengths are then kept near their present ones):
///
/// - `i(mesh, frozen, h)`: report
///
/// Semantics: every frozen side is a side of the result; frozen points keep their index and coordinates bit
/// for bit (other points may be renumbered, removed or added after them); the mesh stays valid and its
/// worst element does not get worse; elements keep tags. Deterministic: stops by counts, never by time.
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
};

} // namespace dovetail
