/// @file
/// What every surface mesher's result must satisfy, whoever made it: the given lines, edge by edge, the given
/// points, elements with the piece's orientation, and on planes the area that the lines enclose.
#pragma once

#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/result_checks.hpp"

namespace dovetail {

namespace detail {

/// `check_entries`, and every element lies on a face that was to be meshed.
void check_entries(const mesher_input<2>& input, const simplicial_mesh<2>& mesh);

} // namespace detail

/// Checks a mesher's or improver's result against its input; throws `mesher_error` that says what is wrong.
/// Linear but for sorting the edges between boundary points.
void check_mesher_result(const mesher_input<2>& input, const simplicial_mesh<2>& mesh);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/surface_checks.ipp"
#endif
