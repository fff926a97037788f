/// @file
/// What `quadratic_element.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace dovetail {

namespace detail {

/// Control points of the element as a Bezier simplex: [i][j] between the corners i and j, [i][i] corner i.
template <int D>
auto control_points(const std::array<vec3, quadratic_nodes<D>>& nodes) {
  constexpr std::size_t corners = D + 1;
  std::array<std::array<vec3, corners>, corners> control;
  for (std::size_t i = 0; i < corners; ++i)
    control[i][i] = nodes[i];
  for (std::size_t e = 0; e < edges_per_element<D>; ++e) {
    const auto i = static_cast<std::size_t>(numbering::edges<D>[e][0]);
    const auto j = static_cast<std::size_t>(numbering::edges<D>[e][1]);
    control[i][j] = control[j][i] = 2 * nodes[corners + e] - midpoint(nodes[i], nodes[j]);
  }
  return control;
}

} // namespace detail

DOVETAIL_INLINE double least_jacobian(const std::array<vec3, quadratic_nodes<2>>& nodes) {
  const auto control = detail::control_points<2>(nodes);
  const vec3 straight = cross(nodes[1] - nodes[0], nodes[2] - nodes[0]);
  const auto along = [&](std::size_t i, std::size_t k) { return 2 * (control[i][k] - control[i][0]); };
  const auto term = [&](std::size_t i, std::size_t j) {
    return dot(cross(along(i, 1), along(j, 2)), straight);
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      least = std::min(least, 0.5 * (term(i, j) + term(j, i)));
  return least / norm_squared(straight);
}

DOVETAIL_INLINE double least_jacobian(const std::array<vec3, quadratic_nodes<3>>& nodes) {
  const auto control = detail::control_points<3>(nodes);
  const auto along = [&](std::size_t i, std::size_t k) { return 2 * (control[i][k] - control[i][0]); };
  const auto term = [&](std::size_t i, std::size_t j, std::size_t k) {
    return dot(cross(along(i, 1), along(j, 2)), along(k, 3));
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i; j < 4; ++j)
      for (std::size_t k = j; k < 4; ++k)
        least = std::min(least, (term(i, j, k) + term(i, k, j) + term(j, i, k) + term(j, k, i) +
                                 term(k, i, j) + term(k, j, i)) /
                                    6);
  return least / (6 * signed_volume(nodes[0], nodes[1], nodes[2], nodes[3]));
}

} // namespace dovetail
