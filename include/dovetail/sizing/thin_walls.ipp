/// @file
/// What `thin_walls.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/prediction.hpp"
#include "dovetail/sizing/thin_walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace dovetail::sizing {

namespace detail {

/// Whether a ray is in a box somewhere before `reach`.
inline bool enters(const box3& box, vec3 from, vec3 direction, double reach) {
  double first = 0, last = reach;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0) {
      if (from[k] < box.lower[k] || from[k] > box.upper[k])
        return false;
      continue;
    }
    const double a = (box.lower[k] - from[k]) / direction[k];
    const double b = (box.upper[k] - from[k]) / direction[k];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

/// Where along a ray its line meets a triangle, or infinity. T. Moeller and B. Trumbore, "Fast, minimum
/// storage ray/triangle intersection", J. Graph. Tools 2 (1997) 21-28.
inline double meeting_place(const std::array<vec3, 3>& corners, vec3 from, vec3 direction) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const vec3 ab = corners[1] - corners[0];
  const vec3 ac = corners[2] - corners[0];
  const vec3 across = cross(direction, ac);
  const double det = dot(ab, across);
  if (det == 0)
    return none;
  const vec3 away = from - corners[0];
  const double u = dot(away, across) / det;
  const vec3 turned = cross(away, ab);
  const double v = dot(direction, turned) / det;
  return u < 0 || v < 0 || u + v > 1 ? none : dot(ac, turned) / det;
}

/// The k-th of points spread evenly over a triangle, by the additive recurrence of M. Roberts' R2 sequence.
inline vec3 point_of_triangle(const std::array<vec3, 3>& corners, std::size_t k) {
  const double n = static_cast<double>(k) + 1;
  double u = std::fmod(0.5 + 0.7548776662466927 * n, 1.0);
  double v = std::fmod(0.5 + 0.5698402909980532 * n, 1.0);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
}

} // namespace detail

DOVETAIL_INLINE ray_search::ray_search(const simplicial_mesh<2>& surface)
    : surface_(surface), tree_(boxes()) {}

DOVETAIL_INLINE std::vector<box3> ray_search::boxes() const {
  std::vector<box3> boxes(surface_.elements.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (const vec3& p : corners(t))
      boxes[t].include(p);
  return boxes;
}

DOVETAIL_INLINE double ray_search::distance(vec3 from, vec3 direction, double reach) const {
  double best = reach;
  const auto visit = [&](local_id t) {
    if (const double at = detail::meeting_place(corners(t), from, direction); at > 1e-6 * reach)
      best = std::min(best, at);
  };
  tree_.for_each([&](const box3& box, std::size_t) { return detail::enters(box, from, direction, best); },
                 visit);
  return best;
}

namespace detail {

/// Elements at a wall per area of one of its sides and per inverse square of the size, as there are at least:
/// triangles of edge length h have 4 / sqrt(3) per square of it; the prism between two is three tetrahedra.
inline constexpr double elements_per_side = 1.5 * elements_per_unit<2>;

/// A sample of the surface of a wall.
struct wall_sample {
  vec3 point;
  double size;      ///< there
  double thickness; ///< a wall is as thick as a ray from the sample is long
  double area;      ///< that it stands for
};

/// Samples a surface, about as densely per element on it everywhere.
class wall_sampler {
public:
  /// Both must outlive the object. Linear in the triangles, but for the tree of the rays.
  wall_sampler(const simplicial_mesh<2>& surface, const any_sizing& h)
      : surface_(surface), h_(h), rays_(surface), expected_(surface.elements.size()) {
    for (std::size_t t = 0; t < expected_.size(); ++t) {
      const auto p = corners(t);
      const double size = dovetail::checked_size(h, (p[0] + p[1] + p[2]) / 3);
      expected_[t] = measure_of<2>(p) / (size * size);
      total_ += expected_[t];
    }
    if (!std::isfinite(total_))
      total_ = 0;
  }

  /// Of the mesh on it; 0 if none is sampled.
  double triangles() const { return elements_per_unit<2> * total_; }

  /// Visits about so many samples. Thicknesses are looked for up to `reach` times the size.
  template <class Visit>
  void for_each(double samples, double reach, const Visit& visit) const {
    for (std::size_t t = 0; total_ > 0 && t < expected_.size(); ++t) {
      const auto p = corners(t);
      const vec3 inwards = -normalized(cross(p[1] - p[0], p[2] - p[0]));
      const auto n = static_cast<std::size_t>(std::ceil(samples * expected_[t] / total_));
      const double part = measure_of<2>(p) / static_cast<double>(n);
      for (std::size_t k = 0; k < n && part > 0; ++k) {
        const vec3 at = point_of_triangle(p, k);
        const double size = dovetail::checked_size(h_, at);
        visit(wall_sample{at, size, rays_.distance(at, inwards, reach * size), part});
      }
    }
  }

private:
  std::array<vec3, 3> corners(std::size_t t) const {
    const auto& v = surface_.elements[t];
    return {surface_.points[v[0]], surface_.points[v[1]], surface_.points[v[2]]};
  }

  const simplicial_mesh<2>& surface_;
  const any_sizing& h_;
  ray_search rays_;
  std::vector<double> expected_; ///< elements on each triangle, but for a factor
  double total_ = 0;
};

} // namespace detail

DOVETAIL_INLINE double elements_in_thin_walls(const simplicial_mesh<2>& surface, const any_sizing& h,
                                              double density) {
  constexpr double per_side = detail::elements_per_side;
  const double thick = 2 * per_side / density; // from there on the integral has as many
  constexpr double samples = 20000;
  double elements = 0;
  detail::wall_sampler(surface, h).for_each(samples, thick, [&](const detail::wall_sample& s) {
    const double ratio = s.thickness / s.size;
    elements += s.area * std::max(0.0, per_side - 0.5 * density * ratio) / (s.size * s.size);
  });
  return elements;
}

DOVETAIL_INLINE std::vector<sized_point> coarse_sizes_in_walls(const simplicial_mesh<2>& surface,
                                                               const any_sizing& h, double scale) {
  constexpr double sizes_per_thickness = 2.5;
  const detail::wall_sampler sampler(surface, h);
  const auto sampled = [&](double count) {
    std::vector<sized_point> sizes;
    sampler.for_each(count, scale / sizes_per_thickness, [&](const detail::wall_sample& s) {
      const double allowed = sizes_per_thickness * s.thickness;
      if (allowed < scale * s.size)
        sizes.push_back({s.point, std::max(allowed, s.size)});
    });
    return sizes;
  };
  constexpr double first_look = 4000, least_share = 0.01, per_coarse_triangle = 2;
  if (static_cast<double>(sampled(first_look).size()) < least_share * first_look)
    return {};
  return sampled(std::clamp(per_coarse_triangle * sampler.triangles() / (scale * scale), 20000.0, 200000.0));
}

} // namespace dovetail::sizing
