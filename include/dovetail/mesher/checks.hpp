/// @file
/// What every volume mesher's result must satisfy, whoever made it: the given boundary, triangle by triangle,
/// the given points, positive elements, and the volume that the boundary encloses.
#pragma once

#include "dovetail/mesher/concepts.hpp"

#include <span>

namespace dovetail {

/// The volume that oriented triangles enclose (positive when they point outwards), by the divergence theorem
/// about the middle of their box, where rounding is least.
double enclosed_volume(std::span<const vec3> points, std::span<const simplex<2>> triangles);

/// Throws `mesher_error` for a boundary that is empty or refers to points that do not exist.
void require_meshable(const simplicial_mesh<2>& boundary);

/// Throws `mesher_error` naming the first element that is flat or inverted.
void check_elements_positive(const simplicial_mesh<3>& mesh);

/// Checks a mesher's or improver's result against the mesher's input; throws `mesher_error` that says what is
/// wrong. The pipeline does so with every result. Linear time, about 0.04 us per
/// element.
void check_mesher_result(const mesher_input<3>& input, const simplicial_mesh<3>& mesh);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/checks.ipp"
#endif
