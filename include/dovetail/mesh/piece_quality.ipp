/// @file
/// What `piece_quality.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/piece_quality.hpp"

#include <algorithm>

namespace dovetail {

DOVETAIL_INLINE void ring_quality::add(double degrees) {
  ++elements;
  min_dihedral_deg = std::min(min_dihedral_deg, degrees);
  sum_of_min_dihedral_deg += degrees;
  min_dihedrals.add(degrees);
}

DOVETAIL_INLINE void ring_quality::merge(const ring_quality& other) {
  elements += other.elements;
  min_dihedral_deg = std::min(min_dihedral_deg, other.min_dihedral_deg);
  sum_of_min_dihedral_deg += other.sum_of_min_dihedral_deg;
  min_dihedrals.merge(other.min_dihedrals);
}

DOVETAIL_INLINE void quality_at_interfaces::merge(const quality_at_interfaces& other) {
  touching.merge(other.touching);
  next_ring.merge(other.next_ring);
  rest.merge(other.rest);
}

} // namespace dovetail
