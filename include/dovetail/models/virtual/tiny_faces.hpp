/// @file
/// Faces far smaller than the size become vertices.
#pragma once

#include "dovetail/models/virtual/editable_topology.hpp"
#include "dovetail/models/virtual/short_edges.hpp"
#include "dovetail/models/virtual/suppressed_detail.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::virtual_topology {

/// Makes a vertex of each face whose edges all are short, as of the corner between three chamfers, where the
/// faces around it get no sharp corner by it or are narrow themselves. Returns how many there were, and
/// appends them to `found`. Linear in the model for each.
std::size_t collapse_tiny_faces(editable_topology& topology, const limits& allowed,
                                std::vector<suppressed_detail>& found);

} // namespace dovetail::virtual_topology

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/virtual/tiny_faces.ipp"
#endif
