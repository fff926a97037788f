/// @file
/// Faces much narrower than the size become curves.
#pragma once

#include "dovetail/models/virtual/editable_topology.hpp"
#include "dovetail/models/virtual/short_edges.hpp"
#include "dovetail/models/virtual/suppressed_detail.hpp"

#include <vector>

namespace dovetail::virtual_topology {

/// Makes a curve of each face that is a narrow strip or ring: of its two long sides one stays, the faces
/// behind the other one end there too, and the short edges between them become vertices. Where one side has a
/// vertex, so gets the other. Not where the two faces would then meet at a sharp angle, as at the rim of a
/// sheet, nor where both are one. Returns how many faces there were, and appends them to `found`.
/// Linear in the model for each face that is a strip.
std::size_t collapse_narrow_faces(editable_topology& topology, const limits& allowed,
                                  std::vector<suppressed_detail>& found);

/// The same, of those alone that meet the faces behind both of their long sides at less than 10 degrees,
/// where these faces go on along each other: the surface goes there, back and there again.
std::size_t collapse_folded_faces(editable_topology& topology, const limits& allowed,
                                  std::vector<suppressed_detail>& found);

/// Makes a curve of the end of each face that runs into a point, as far as it is narrow; else as narrow
/// faces.
std::size_t collapse_narrow_ends(editable_topology& topology, const limits& allowed,
                                 std::vector<suppressed_detail>& found);

} // namespace dovetail::virtual_topology

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/virtual/narrow_faces.ipp"
#endif
