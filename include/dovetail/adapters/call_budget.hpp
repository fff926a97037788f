/// @file
/// How many sizing evaluations a mesher may need at most: the watchdog against endless refinement.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <cmath>
#include <cstddef>

namespace dovetail {

namespace detail {

/// Integral of h^-3 over a box by an octree that splits while the smallest and largest sampled size differ by
/// more than a factor 1.5, to a depth of 7; errs on the large side.
double integral_of_inverse_cube(const any_sizing& size, const box3& whole);

} // namespace detail

/// `factor` times the number of elements predicted for the boundary's box (an overestimate of the piece),
/// plus a share for boundaries finer than the field. Deterministic; at most a few million evaluations, a few
/// hundred for a uniform field. Throws `sizing_error` when the field gives an unusable size.
/// \param elements_per_inverse_cubed_size elements that the mesher makes per cube of the size; 0: of regular
///   elements
std::size_t sizing_call_budget(const simplicial_mesh<2>& boundary, const any_sizing& size,
                               double elements_per_inverse_cubed_size, double factor);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/adapters/call_budget.ipp"
#endif
