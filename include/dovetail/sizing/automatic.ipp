/// @file
/// What `automatic.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/sizing/automatic.hpp"
#include "dovetail/sizing/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE void automatic_points::add(const std::vector<sizing::gap_point>& gaps) {
  points_.insert(points_.end(), gaps.begin(), gaps.end());
  for (const sizing::gap_point& p : gaps)
    if (p.size < range_.smallest)
      walls_.push_back(p);
}

DOVETAIL_INLINE double automatic_points::elements_at(const sizing::gap_point& wall, double size) const {
  constexpr double per_triangle = 1.5; // of the three tetrahedra of a prism, for each of its two triangles
  const double more = 1 / (size * size) - 1 / (range_.smallest * range_.smallest);
  return per_triangle * elements_per_unit<2> * wall.area * std::max(0.0, more);
}

DOVETAIL_INLINE double automatic_points::elements_in_walls(const thin_wall_sizes& walls) const {
  double elements = 0;
  for (const sizing::gap_point& wall : walls_)
    if (const double size = walls.factor * wall.size; size >= walls.least)
      elements += elements_at(wall, size);
  return elements;
}

DOVETAIL_INLINE thin_wall_sizes automatic_points::walls_within(double elements) const {
  constexpr double coarsest = 1.5; // where walls are half as thick as their sizes
  elements = std::max(1.0, elements);
  const double excess = elements_in_walls() / elements;
  if (excess <= coarsest * coarsest)
    return {.factor = std::max(1.0, std::sqrt(excess))};
  std::vector<sizing::gap_point> thickest_first = walls_;
  sort_all(thickest_first, [](const auto& a, const auto& b) { return a.size > b.size; });
  double sum = 0;
  for (const sizing::gap_point& wall : thickest_first)
    if (sum += elements_at(wall, coarsest * wall.size); sum > elements) {
      // A sheet has one thickness but for rounding: it is resolved as a whole or not at all.
      constexpr double same = 1.05;
      return {.factor = coarsest, .least = std::min(range_.smallest, same * coarsest * wall.size)};
    }
  return {.factor = coarsest};
}

DOVETAIL_INLINE tabulated_size automatic_points::field(const thin_wall_sizes& walls) const {
  std::vector<sized_point> points = points_;
  for (sized_point& p : points)
    if (p.size < range_.smallest) {
      const double wanted = walls.factor * p.size;
      p.size = wanted < walls.least ? range_.smallest : std::min(wanted, range_.smallest);
    }
  return {point_sizes(std::move(points), range_.growth, range_.largest),
          inflated(bounds_, 1e-3 * bounds_.diagonal())};
}

} // namespace dovetail
