/// @file
/// Gaps between two edges of a solid, where they begin, become edges.
#pragma once

#include "dovetail/models/virtual/editable_topology.hpp"
#include "dovetail/models/virtual/short_edges.hpp"
#include "dovetail/models/virtual/suppressed_detail.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::virtual_topology {

/// Makes one curve of two that leave a vertex beside each other with the inside of one solid between them, as
/// far as the gap is narrow: a solid that touches itself at the vertex, as where a bend begins in the plane
/// of another face, is open beside it by a slit that no element fits into. Not where the faces at the two
/// curves would then meet at a sharp angle. Returns how many there were, and appends them to `found`.
/// Quadratic in the curves of a vertex; linear in the model for each gap.
std::size_t collapse_narrow_gaps(editable_topology& topology, const limits& allowed,
                                 std::vector<suppressed_detail>& found);

} // namespace dovetail::virtual_topology

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/virtual/narrow_gaps.ipp"
#endif
