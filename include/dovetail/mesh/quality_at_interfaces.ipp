/// @file
/// What `quality_at_interfaces.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/quality_at_interfaces.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

namespace detail {

/// Per point of a piece whether it is on one of its interfaces. A side with the piece on both of its sides is
/// none.
template <int D>
std::vector<std::uint8_t> points_on_interfaces(const simplicial_piece<D>& piece,
                                               const simplicial_skeleton<D>& skeleton,
                                               std::span<const local_id> listed) {
  std::vector<local_id> on_interfaces; // by their numbers in the skeleton
  for (const local_id s : listed) {
    const auto [behind, front] = skeleton.subdomains[s];
    if (front == no_id || front == behind)
      continue;
    const auto& side = skeleton.sides[s];
    on_interfaces.insert(on_interfaces.end(), side.begin(), side.end());
  }
  sort_all(on_interfaces);
  std::vector<std::uint8_t> marked(piece.mesh.points.size(), 0);
  for (std::size_t v = 0; v < piece.skeleton_points.size(); ++v)
    marked[v] =
        std::binary_search(on_interfaces.begin(), on_interfaces.end(), piece.skeleton_points[v]) ? 1 : 0;
  return marked;
}

/// The rest is what the rings leave of all.
inline void add_what_is_left(quality_at_interfaces& found, const quality_statistics& of_all,
                             bool is_worst_in_rest) {
  ring_quality& rest = found.rest;
  rest.elements = of_all.elements - found.touching.elements - found.next_ring.elements;
  if (rest.elements == 0)
    return;
  rest.sum_of_min_dihedral_deg = of_all.sum_of_min_dihedral_deg - found.touching.sum_of_min_dihedral_deg -
                                 found.next_ring.sum_of_min_dihedral_deg;
  for (std::size_t k = 0; k < rest.min_dihedrals.bins.size(); ++k)
    rest.min_dihedrals.bins[k] = of_all.min_dihedrals.bins[k] - found.touching.min_dihedrals.bins[k] -
                                 found.next_ring.min_dihedrals.bins[k];
  if (is_worst_in_rest)
    rest.min_dihedral_deg = of_all.min_dihedral_deg;
}

} // namespace detail

template <int D>
quality_at_interfaces measure_at_interfaces(const simplicial_mesh<D>& mesh,
                                            const std::vector<std::uint8_t>& on_interface,
                                            const quality_statistics* of_all) {
  const auto& elements = mesh.elements;
  const auto has_one_in = [](const simplex<D>& element, const std::vector<std::uint8_t>& marked) {
    return std::any_of(element.begin(), element.end(), [&](local_id v) { return marked[v] != 0; });
  };
  auto reached = on_interface; // the points of the elements that touch
  for (const simplex<D>& element : elements)
    if (has_one_in(element, on_interface))
      for (const local_id v : element)
        reached[v] = 1;
  const auto smallest_angle = [&](const simplex<D>& element) {
    return extreme_dihedral_angles(corners(span_of(mesh.points), element))[0];
  };
  quality_at_interfaces found;
  const bool is_worst_in_rest = of_all != nullptr && of_all->worst_element >= 0 &&
                                !has_one_in(elements[of_all->worst_element], reached);
  for (const simplex<D>& element : elements)
    if (has_one_in(element, on_interface))
      found.touching.add(smallest_angle(element));
    else if (has_one_in(element, reached))
      found.next_ring.add(smallest_angle(element));
    else if (of_all == nullptr)
      found.rest.add(smallest_angle(element));
    else if (!is_worst_in_rest)
      found.rest.min_dihedral_deg = std::min(found.rest.min_dihedral_deg, smallest_angle(element));
  if (of_all != nullptr)
    detail::add_what_is_left(found, *of_all, is_worst_in_rest);
  return found;
}

template <int D>
quality_at_interfaces
measure_at_interfaces(const simplicial_piece<D>& piece, const simplicial_skeleton<D>& skeleton,
                      std::span<const local_id> listed, const quality_statistics* of_all) {
  return measure_at_interfaces<D>(piece.mesh, detail::points_on_interfaces(piece, skeleton, listed), of_all);
}

#ifdef DOVETAIL_COMPILED
template quality_at_interfaces measure_at_interfaces<2>(const simplicial_mesh<2>& mesh,
                                                        const std::vector<std::uint8_t>& on_interface,
                                                        const quality_statistics* of_all);
template quality_at_interfaces measure_at_interfaces<3>(const simplicial_mesh<3>& mesh,
                                                        const std::vector<std::uint8_t>& on_interface,
                                                        const quality_statistics* of_all);
template quality_at_interfaces measure_at_interfaces<2>(const simplicial_piece<2>& piece,
                                                        const simplicial_skeleton<2>& skeleton,
                                                        std::span<const local_id> listed,
                                                        const quality_statistics* of_all);
template quality_at_interfaces measure_at_interfaces<3>(const simplicial_piece<3>& piece,
                                                        const simplicial_skeleton<3>& skeleton,
                                                        std::span<const local_id> listed,
                                                        const quality_statistics* of_all);
#endif

} // namespace dovetail
