/// @file
/// What is measured of the elements of a piece, with those at interfaces apart.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/mesh/quality.hpp"

#include <cstdint>
#include <optional>

namespace dovetail {

/// The smallest angles of some elements, which can be merged from pieces. Angles as in `quality_statistics`.
struct ring_quality {
  std::int64_t elements = 0;          ///< how many they are
  double min_dihedral_deg = 180;      ///< 180 without elements
  double sum_of_min_dihedral_deg = 0; ///< over elements; see mean_min_dihedral_deg
  angle_histogram min_dihedrals;      ///< each element's smallest angle

  /// The mean over the elements of their smallest angle; 0 without elements.
  double mean_min_dihedral_deg() const {
    return elements == 0 ? 0 : sum_of_min_dihedral_deg / static_cast<double>(elements);
  }
  /// Counts an element with this smallest angle.
  void add(double degrees);
  /// Adds others.
  void merge(const ring_quality& other);

  using fields = field_list<&ring_quality::elements, &ring_quality::min_dihedral_deg,
                            &ring_quality::sum_of_min_dihedral_deg, &ring_quality::min_dihedrals>;
};

/// Elements by their distance from the interfaces, which are the sides between two subdomains. Of each
/// element its own piece decides, so that no other one is needed; only where a piece has a point of an
/// interface, but no side there, would its neighbours have it otherwise.
struct quality_at_interfaces {
  ring_quality touching;  ///< a vertex is on an interface of its piece
  ring_quality next_ring; ///< not of these, but shares a vertex with one
  ring_quality rest;      ///< all others

  /// Adds those of another piece.
  void merge(const quality_at_interfaces& other);

  using fields = field_list<&quality_at_interfaces::touching, &quality_at_interfaces::next_ring,
                            &quality_at_interfaces::rest>;
};

/// Of one piece.
struct piece_quality {
  quality_statistics all;                                  ///< of its elements
  std::optional<quality_at_interfaces> at_interfaces = {}; ///< nothing where nobody has measured them apart

  using fields = field_list<&piece_quality::all, &piece_quality::at_interfaces>;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/piece_quality.ipp"
#endif
