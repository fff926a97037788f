/// @file
/// The fine boundary of each subdomain, cut from the fine skeleton: what its mesher gets.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail {

/// Which sides of the fine skeleton bound which subdomain. A side with one subdomain on both of its sides is
/// listed twice in a row.
struct sides_of_subdomains {
  std::vector<std::size_t> begins{0};
  std::vector<local_id> sides; ///< growing within a subdomain
};

/// Sorts the skeleton's sides by subdomain; linear.
template <int D>
sides_of_subdomains sort_by_subdomain(const simplicial_skeleton<D>& skeleton, std::size_t subdomains) {
  sides_of_subdomains sorted;
  sorted.begins.assign(subdomains + 1, 0);
  const auto for_each_owner = [&](const auto& visit) {
    for (std::size_t t = 0; t < skeleton.subdomains.size(); ++t)
      for (const local_id s : skeleton.subdomains[t])
        if (s != no_id)
          visit(static_cast<std::size_t>(s), static_cast<local_id>(t));
  };
  for_each_owner([&](std::size_t s, local_id) { ++sorted.begins[s + 1]; });
  for (std::size_t s = 0; s < subdomains; ++s)
    sorted.begins[s + 1] += sorted.begins[s];
  sorted.sides.resize(sorted.begins.back());
  auto next = sorted.begins;
  for_each_owner([&](std::size_t s, local_id t) { sorted.sides[next[s]++] = t; });
  return sorted;
}

/// The closed boundary of one subdomain on points of its own, oriented outwards.
template <int D>
struct subdomain_sides {
  simplicial_mesh<D - 1> boundary;
  std::vector<local_id> skeleton_points; ///< per point: its number in the skeleton, growing
};

/// Cuts the boundary of a subdomain out of the skeleton. O(n log n) in its sides.
template <int D>
subdomain_sides<D> boundary_of_subdomain(const simplicial_skeleton<D>& skeleton,
                                         const sides_of_subdomains& sorted, local_id subdomain) {
  const auto s = static_cast<std::size_t>(subdomain);
  subdomain_sides<D> made;
  for (std::size_t k = sorted.begins[s]; k < sorted.begins[s + 1]; ++k) {
    const auto t = static_cast<std::size_t>(sorted.sides[k]);
    simplex<D - 1> side = sides_of(skeleton)[t];
    const bool second_passage = k > sorted.begins[s] && sorted.sides[k - 1] == sorted.sides[k];
    if (skeleton.subdomains[t][0] != subdomain || second_passage)
      std::swap(side[D - 2], side[D - 1]);
    made.boundary.elements.push_back(side);
    append(made.skeleton_points, side);
  }
  auto& numbers = made.skeleton_points;
  sort_unique(numbers);
  for (const local_id number : numbers)
    made.boundary.points.push_back(skeleton.points[static_cast<std::size_t>(number)]);
  for (simplex<D - 1>& side : made.boundary.elements)
    for (local_id& v : side)
      v = static_cast<local_id>(std::lower_bound(numbers.begin(), numbers.end(), v) - numbers.begin());
  return made;
}

} // namespace dovetail
