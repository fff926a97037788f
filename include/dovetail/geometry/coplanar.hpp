/// @file
/// Which planes are the same.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/concepts.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail {

/// Of planes in which chords and triangles of two faces could coincide.
inline constexpr double coplanar_tolerance = 1e-6;

/// Whether two planes have the same normal but for its sign, and the points of both frames are in both.
/// \param tolerance of the sine of the angle between them, and of lengths as a share of `extent`
/// \param extent a length, as that of the model's diagonal
inline bool are_coplanar(const surface_frame& a, const surface_frame& b, double extent, double tolerance) {
  const vec3 n = normalized(cross(a.du, a.dv)), m = normalized(cross(b.du, b.dv));
  return norm(cross(n, m)) < tolerance && std::abs(dot(n, b.point - a.point)) < tolerance * extent;
}

/// Numbers of planes: the same for those that are `are_coplanar` with the first of their number; `no_id`
/// where there is none.
/// Complexity: n log n, as long as few different planes have nearly the same direction and place.
/// \param planes frames of planes, or none
/// \param extent a length, as that of the model's diagonal
/// \param tolerance of the sine of angles, and of lengths as a share of `extent`
inline std::vector<local_id> plane_numbers(const std::vector<std::optional<surface_frame>>& planes,
                                           double extent, double tolerance) {
  // Planes that are the same have nearly the same value of a smooth function of normal and offset.
  constexpr vec3 direction{0.6123, 0.3571, 0.7054}, weights{0.8419, 0.2237, 0.4911}; // of no model's planes
  constexpr double of_offset = 0.7321, window = 8;
  std::vector<std::pair<double, std::size_t>> by_value;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (planes[i]) {
      vec3 n = normalized(cross(planes[i]->du, planes[i]->dv));
      if (dot(n, direction) < 0)
        n = -n;
      by_value.emplace_back(dot(n, weights) + of_offset * dot(n, planes[i]->point) / extent, i);
    }
  sort_all(by_value);
  std::vector<local_id> numbers(planes.size(), no_id);
  std::vector<std::pair<double, std::size_t>> firsts; // of each number, in their order
  for (const auto& [value, i] : by_value) {
    for (std::size_t k = firsts.size(); k > 0 && value - firsts[k - 1].first < window * tolerance; --k)
      if (are_coplanar(*planes[firsts[k - 1].second], *planes[i], extent, tolerance)) {
        numbers[i] = static_cast<local_id>(k - 1);
        break;
      }
    if (numbers[i] == no_id) {
      numbers[i] = static_cast<local_id>(firsts.size());
      firsts.emplace_back(value, i);
    }
  }
  return numbers;
}

} // namespace dovetail
