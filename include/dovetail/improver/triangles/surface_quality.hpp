/// @file
/// Quality counts of a surface, of the triangles that its fixed sides limit and of the rest.
#pragma once

#include "dovetail/improver/quality_counts.hpp"
#include "dovetail/improver/triangles/surface_complex.hpp"

#include <array>
#include <utility>
#include <vector>

namespace dovetail::improvement {

/// Triangles with a smaller angle are low; under half of it they are bad.
inline constexpr double low_triangle_angle = 30;

/// Which points have two fixed sides that meet at less than `low_triangle_angle` inside the mesh: no
/// triangulation has a better angle there.
std::vector<bool> limiting_points(const surface_complex& mesh);

/// The cosines of the smallest and of the largest angle of a triangle.
std::array<double, 2> extreme_cosines(vec3 a, vec3 b, vec3 c);

/// Counts triangles by their smallest angle. Limited are those that touch a limiting point. O(triangles).
quality_counts count_quality(const surface_complex& mesh);

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/triangles/surface_quality.ipp"
#endif
