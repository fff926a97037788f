/// @file
/// Statistics of the elements at interfaces, beside those of the others: what a decomposition costs in
/// quality shows there first, and drowns in the whole mesh.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/quality.hpp"

#include <cstdint>
#include <span>
#include <vector>

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

/// Measures the elements of a piece whose points on interfaces are known. Linear.
/// Throws nothing but for a lack of memory.
/// \param mesh the elements of one subdomain
/// \param on_interface not 0 for points of an interface; one per point of the mesh
template <int D>
quality_at_interfaces measure_at_interfaces(const simplicial_mesh<D>& mesh,
                                            const std::vector<std::uint8_t>& on_interface);

/// Measures the elements of a piece. Linear, and n log n in its skeleton points.
/// Throws nothing but for a lack of memory.
/// \param piece as `check_piece` finds it right
/// \param skeleton that of its mesh
/// \param listed the numbers of the skeleton's sides at this piece: `io::sides_by_subdomain`
template <int D>
quality_at_interfaces measure_at_interfaces(const simplicial_piece<D>& piece,
                                            const simplicial_skeleton<D>& skeleton,
                                            std::span<const local_id> listed);

#ifdef DOVETAIL_COMPILED
extern template quality_at_interfaces measure_at_interfaces<2>(const simplicial_mesh<2>& mesh,
                                                               const std::vector<std::uint8_t>& on_interface);
extern template quality_at_interfaces measure_at_interfaces<3>(const simplicial_mesh<3>& mesh,
                                                               const std::vector<std::uint8_t>& on_interface);
extern template quality_at_interfaces measure_at_interfaces<2>(const simplicial_piece<2>& piece,
                                                               const simplicial_skeleton<2>& skeleton,
                                                               std::span<const local_id> listed);
extern template quality_at_interfaces measure_at_interfaces<3>(const simplicial_piece<3>& piece,
                                                               const simplicial_skeleton<3>& skeleton,
                                                               std::span<const local_id> listed);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/quality_at_interfaces.ipp"
#endif
