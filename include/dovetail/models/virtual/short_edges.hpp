/// @file
/// Edges much shorter than the size become vertices.
#pragma once

#include "dovetail/models/virtual/editable_topology.hpp"
#include "dovetail/models/virtual/suppressed_detail.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <vector>

namespace dovetail::virtual_topology {

/// Up to what an entity is a detail, and what may not come of it.
struct limits {
  any_sizing length;                     ///< what is at most so long or wide, there, is a detail
  double least_angle_deg = 40;           ///< no edge becomes sharper, but at the bottom of a slit
  double least_corner_deg = 28;          ///< nor does a corner of a face
  std::vector<local_id> kept_faces = {}; ///< whose boundaries stay
};

inline constexpr double furthest_vertex = 1.5; ///< limits: none is moved further, in how many steps ever
inline constexpr double least_loop = 6; ///< limits: what is left of a smaller one would be no face's outline

/// Whether a curve is that short.
bool is_short(const editable_topology& topology, const limits& allowed, local_id c);

/// Whether a passage may be taken out of its loop: the loop stays one, far longer than the limit, without a
/// corner sharper than allowed, unless it was so before, or the face is all around it.
bool can_be_dropped(const editable_topology& topology, const limits& allowed, const passage& p);

/// Whether the boundaries of all faces that must be kept are the same in both.
bool keeps_faces(const editable_topology& before, const editable_topology& after, const limits& allowed);

/// Makes vertices of short edges, the shortest first, where no face gets a sharp corner by it. Returns how
/// many there were, and appends them to `found`. Quadratic in the short edges at worst.
std::size_t collapse_short_edges(editable_topology& topology, const limits& allowed,
                                 std::vector<suppressed_detail>& found);

} // namespace dovetail::virtual_topology

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/virtual/short_edges.ipp"
#endif
