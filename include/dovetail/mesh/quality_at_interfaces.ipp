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

} // namespace detail

template <int D>
quality_at_interfaces measure_at_interfaces(const simplicial_mesh<D>& mesh,
                                            const std::vector<std::uint8_t>& on_interface) {
  const auto& elements = mesh.elements;
  const auto has_one_in = [](const simplex<D>& element, const std::vector<std::uint8_t>& marked) {
    return std::any_of(element.begin(), element.end(), [&](local_id v) { return marked[v] != 0; });
  };
  auto reached = on_interface; // the points of the elements that touch
  for (const simplex<D>& element : elements)
    if (has_one_in(element, on_interface))
      for (const local_id v : element)
        reached[v] = 1;
  quality_at_interfaces found;
  for (const simplex<D>& element : elements) {
    ring_quality& ring = has_one_in(element, on_interface) ? found.touching
                         : has_one_in(element, reached)    ? found.next_ring
                                                           : found.rest;
    ring.add(extreme_dihedral_angles(corners(span_of(mesh.points), element))[0]);
  }
  return found;
}

template <int D>
quality_at_interfaces measure_at_interfaces(const simplicial_piece<D>& piece,
                                            const simplicial_skeleton<D>& skeleton,
                                            std::span<const local_id> listed) {
  return measure_at_interfaces<D>(piece.mesh, detail::points_on_interfaces(piece, skeleton, listed));
}

#ifdef DOVETAIL_COMPILED
template quality_at_interfaces measure_at_interfaces<2>(const simplicial_mesh<2>& mesh,
                                                        const std::vector<std::uint8_t>& on_interface);
template quality_at_interfaces measure_at_interfaces<3>(const simplicial_mesh<3>& mesh,
                                                        const std::vector<std::uint8_t>& on_interface);
template quality_at_interfaces measure_at_interfaces<2>(const simplicial_piece<2>& piece,
                                                        const simplicial_skeleton<2>& skeleton,
                                                        std::span<const local_id> listed);
template quality_at_interfaces measure_at_interfaces<3>(const simplicial_piece<3>& piece,
                                                        const simplicial_skeleton<3>& skeleton,
                                                        std::span<const local_id> listed);
#endif

} // namespace dovetail
