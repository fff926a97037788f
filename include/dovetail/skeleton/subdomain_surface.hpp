/// @file
/// The fine boundary of each subdomain, cut from the fine skeleton: what its mesher gets.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dovetail {

/// Which triangles of the fine skeleton bound which subdomain.
struct triangles_of_subdomains {
  std::vector<std::size_t> begins{0};
  std::vector<local_id> triangles; ///< growing within a subdomain
};

/// Sorts the skeleton's triangles by subdomain; linear.
inline triangles_of_subdomains sort_by_subdomain(const fine_skeleton& skeleton, std::size_t subdomains) {
  triangles_of_subdomains sorted;
  sorted.begins.assign(subdomains + 1, 0);
  const auto for_each_owner = [&](const auto& visit) {
    for (std::size_t t = 0; t < skeleton.triangles.size(); ++t)
      for (const local_id s : skeleton.subdomains[t])
        if (s != no_id)
          visit(static_cast<std::size_t>(s), static_cast<local_id>(t));
  };
  for_each_owner([&](std::size_t s, local_id) { ++sorted.begins[s + 1]; });
  for (std::size_t s = 0; s < subdomains; ++s)
    sorted.begins[s + 1] += sorted.begins[s];
  sorted.triangles.resize(sorted.begins.back());
  auto next = sorted.begins;
  for_each_owner([&](std::size_t s, local_id t) { sorted.triangles[next[s]++] = t; });
  return sorted;
}

/// The closed boundary of one subdomain on points of its own, oriented outwards.
struct subdomain_surface {
  simplicial_mesh<2> boundary;
  std::vector<local_id> skeleton_points; ///< per point: its number in the skeleton, growing
};

inline subdomain_surface surface_of_subdomain(const fine_skeleton& skeleton,
                                              const triangles_of_subdomains& sorted, local_id subdomain) {
  const auto s = static_cast<std::size_t>(subdomain);
  subdomain_surface surface;
  for (std::size_t k = sorted.begins[s]; k < sorted.begins[s + 1]; ++k) {
    const auto t = static_cast<std::size_t>(sorted.triangles[k]);
    simplex<2> triangle = skeleton.triangles[t];
    if (skeleton.subdomains[t][0] != subdomain)
      std::swap(triangle[1], triangle[2]);
    surface.boundary.elements.push_back(triangle);
    surface.skeleton_points.insert(surface.skeleton_points.end(), triangle.begin(), triangle.end());
  }
  auto& numbers = surface.skeleton_points;
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  for (const local_id number : numbers)
    surface.boundary.points.push_back(skeleton.points[static_cast<std::size_t>(number)]);
  for (simplex<2>& triangle : surface.boundary.elements)
    for (local_id& v : triangle)
      v = static_cast<local_id>(std::lower_bound(numbers.begin(), numbers.end(), v) - numbers.begin());
  return surface;
}

} // namespace dovetail
