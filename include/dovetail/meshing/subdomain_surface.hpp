/// @file
/// The fine boundary of each subdomain, cut from the fine skeleton: what its mesher gets.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// The closed boundary of one subdomain on points of its own, oriented outwards.
template <int D>
struct subdomain_sides {
  simplicial_mesh<D - 1> boundary;        ///< points and oriented sides
  std::vector<local_id> skeleton_points;  ///< per point: its number in the skeleton, growing
  std::vector<std::uint8_t> on_interface; ///< per point: not 0 on a side with another subdomain behind it
};

/// The points of the skeleton on the boundary of one subdomain, growing. O(n log n) in its sides.
template <int D>
std::vector<local_id> points_of_subdomain(std::span<const simplex<D - 1>> sides,
                                          const sides_of_subdomains& sorted, local_id subdomain) {
  std::vector<local_id> numbers;
  for (const local_id side : sorted[subdomain])
    append(numbers, sides[side]);
  sort_unique(numbers);
  return numbers;
}

/// Cuts the boundary of a subdomain out of the skeleton. O(n log n) in its sides.
/// Throws nothing but for a lack of memory.
/// \param skeleton the fine skeleton
/// \param sorted `sort_by_subdomain` of it
/// \param subdomain from 0
template <int D>
subdomain_sides<D> boundary_of_subdomain(const simplicial_skeleton<D>& skeleton,
                                         const sides_of_subdomains& sorted, local_id subdomain) {
  const auto sides = sorted[subdomain];
  subdomain_sides<D> made;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto t = static_cast<std::size_t>(sides[k]);
    simplex<D - 1> side = skeleton.sides[t];
    const bool second_passage = k > 0 && sides[k - 1] == sides[k];
    if (skeleton.subdomains[t][0] != subdomain || second_passage)
      std::swap(side[D - 2], side[D - 1]);
    made.boundary.elements.push_back(side);
  }
  const auto& numbers = made.skeleton_points =
      points_of_subdomain<D>(span_of(skeleton.sides), sorted, subdomain);
  for (const local_id number : numbers)
    made.boundary.points.push_back(skeleton.points[number]);
  made.on_interface.assign(numbers.size(), 0);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto [behind, front] = skeleton.subdomains[sides[k]];
    const bool is_interface = front != no_id && front != behind;
    for (local_id& v : made.boundary.elements[k]) {
      v = static_cast<local_id>(std::lower_bound(numbers.begin(), numbers.end(), v) - numbers.begin());
      if (is_interface)
        made.on_interface[v] = 1;
    }
  }
  if constexpr (D ==
                2) // the skeleton's order along a line hangs on how the subdomains beside it are numbered
    sort_all(made.boundary.elements);
  return made;
}

} // namespace dovetail
