/// @file
/// What `given_points_first.hpp` declares.
#pragma once

#include "dovetail/adapters/given_points_first.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE simplicial_mesh<3> with_given_points_first(const std::vector<vec3>& given,
                                                           const std::vector<vec3>& points,
                                                           std::vector<simplex<3>> elements) {
  const auto less = [](vec3 a, vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::vector<local_id> sorted(given.size());
  std::iota(sorted.begin(), sorted.end(), local_id{0});
  const auto at = [&](local_id v) { return given[v]; };
  std::sort(sorted.begin(), sorted.end(), [&](local_id a, local_id b) { return less(at(a), at(b)); });
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (at(sorted[k - 1]) == at(sorted[k]))
      throw mesher_error("boundary points " + std::to_string(sorted[k - 1]) + " and " +
                         std::to_string(sorted[k]) + " coincide");

  simplicial_mesh<3> mesh{given, std::move(elements), {}};
  std::vector<local_id> number(points.size());
  for (std::size_t k = 0; k < number.size(); ++k) {
    const vec3 p = points[k];
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), p,
                                        [&](local_id v, vec3 point) { return less(at(v), point); });
    if (found != sorted.end() && at(*found) == p) {
      number[k] = *found;
    } else {
      number[k] = static_cast<local_id>(mesh.points.size());
      mesh.points.push_back(p);
    }
  }
  for (auto& element : mesh.elements)
    for (local_id& v : element)
      v = number[v];
  return mesh;
}

} // namespace dovetail
