/// @file
/// What every volume mesher's result must satisfy, whoever made it: the given boundary, triangle by triangle,
/// the given points, positive elements, and the volume that the boundary encloses.
#pragma once

#include "dovetail/mesher/concepts.hpp"

#include <span>

namespace dovetail {

/// The volume that oriented triangles enclose (positive when they point outwards), by the divergence theorem
/// about the middle of their box, where rounding is least.
/// Linear. Throws nothing; indices are not checked.
/// \param points coordinates
/// \param triangles three indices of points each, oriented alike
double enclosed_volume(std::span<const vec3> points, std::span<const simplex<2>> triangles);

/// Throws `mesher_error` for a boundary that is empty, refers to points that do not exist or has a point that
/// is not finite.
/// Linear.
/// \param boundary triangles (D = 3)
void require_meshable(const simplicial_mesh<2>& boundary);

/// The same, and for a boundary that no elements can be inside of, whoever makes them: one with a flat
/// triangle, with an edge that is not passed as often in one direction as in the other, since a triangle is
/// missing, there twice or turned over, or one that encloses nothing, since it is oriented inwards. What
/// `mesh_subdomains` asks of a boundary before any mesher is blamed for it. Linear, about 0.1 us per
/// triangle.
/// Throws `mesher_error`.
/// \param boundary closed triangles, oriented outwards
void require_enclosing(const simplicial_mesh<2>& boundary);

/// Throws `mesher_error` naming the first element that is flat or inverted.
/// Linear.
/// \param mesh tetrahedra
void check_elements_positive(const simplicial_mesh<3>& mesh);

/// Checks a mesher's or improver's result against the mesher's input; throws `mesher_error` that says what is
/// wrong. The pipeline does so with every result. Linear time, about 0.04 us per
/// element.
/// \param input what the mesher was given
/// \param mesh what it made
void check_mesher_result(const mesher_input<3>& input, const simplicial_mesh<3>& mesh);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/checks.ipp"
#endif
