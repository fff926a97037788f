/// @file
/// Improves a meshed piece inside its frozen boundary: tetrahedra, or triangles that stay on their surfaces.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/improve_on_host.hpp"
#include "dovetail/mesh/unused_points.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/surface_checks.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The surfaces of a piece as the host of its triangles; it keeps what it needs of `input`.
surface_host host_of_piece(const mesher_input<2>& input, std::vector<std::array<vec2, 3>> corner_uv);

/// Which points of a piece are poles: ends of segments that are a point in space.
std::vector<bool> poles_of(const mesher_input<2>& input, std::size_t points);

/// Improves tetrahedra inside their frozen boundary.
template <improver<3> Improver>
report improve_piece(mesher_result<3>& made, const mesher_input<3>& input, const Improver& improve,
                     const any_sizing& size) {
  frozen_entities<3> frozen;
  frozen.points = static_cast<local_id>(input.boundary.points.size());
  frozen.sides = input.boundary.elements;
  return improve(made.mesh, frozen, size);
}

/// Inner sides between points of the lines that another region might have too: their ends and their face.
std::vector<std::array<local_id, 3>> forbidden_chords(const simplicial_mesh<2>& mesh,
                                                      const mesher_input<2>& input);

/// Freezes the sides of all triangles at the ends of the chords: then no such chord can be made.
void freeze_around(const std::vector<std::array<local_id, 3>>& chords, const simplicial_mesh<2>& mesh,
                   frozen_entities<2>& frozen);

/// Improves the triangles by `improve(mesh, frozen)`, again with more frozen where that made chords that
/// another region might have; such a side or triangle would be in the mesh twice.
template <class Improve>
report improve_without_chords(simplicial_mesh<2>& mesh, const mesher_input<2>& input,
                              frozen_entities<2>& frozen, const Improve& improve) {
  constexpr int most_attempts = 4;
  const auto as_meshed = forbidden_chords(mesh, input); // of a face's other regions in this piece
  for (int attempt = 1;; ++attempt) {
    simplicial_mesh<2> improved = mesh;
    report result = improve(improved, frozen);
    check_entries(input, improved);
    const auto found = forbidden_chords(improved, input);
    std::vector<std::array<local_id, 3>> chords;
    std::set_difference(found.begin(), found.end(), as_meshed.begin(), as_meshed.end(),
                        std::back_inserter(chords));
    if (chords.empty())
      mesh = std::move(improved);
    else if (attempt < most_attempts) {
      freeze_around(chords, mesh, frozen);
      continue;
    } else { // what was counted is of a mesh that is not taken
      report given_up;
      given_up.name = result.name;
      given_up.seconds = result.seconds;
      given_up.warnings = {"a piece stays as meshed: improved, it would touch a neighbour"};
      return given_up;
    }
    return result;
  }
}

/// Improves triangles inside their frozen lines.
template <improver<2> Improver>
report improve_piece(mesher_result<2>& made, const mesher_input<2>& input, const Improver& improve,
                     const any_sizing& size) {
  frozen_entities<2> frozen;
  frozen.points = static_cast<local_id>(input.boundary.points.size());
  frozen.sides = input.boundary.elements;
  const auto at_poles = sides_at_poles(made.mesh, poles_of(input, made.mesh.points.size()));
  append(frozen.sides, at_poles);
  const std::size_t of_lines = input.boundary.points.size();
  const surface_host host = host_of_piece(input, std::move(made.corner_uv));
  report result = improve_without_chords(made.mesh, input, frozen,
                                         [&](simplicial_mesh<2>& mesh, const frozen_entities<2>& kept) {
                                           return improve_on_host(improve, mesh, kept, size, host);
                                         });
  drop_unused_points(made.mesh, of_lines); // an improver leaves gaps before points that it may not renumber
  return result;
}

} // namespace dovetail::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/meshing/piece_improvement.ipp"
#endif
