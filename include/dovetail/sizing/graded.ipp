/// @file
/// What `graded.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/graded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE void graded_size::encode(byte_writer& to) const {
  to.value(tree_.bounds());
  to.array(tree_.splits());
  to.array(values_);
  to.value(options_.slope);
  to.value(error_);
  to.value(smallest_);
}

DOVETAIL_INLINE graded_size graded_size::decode(byte_reader& from) {
  const auto cube = from.value<box3>();
  graded_size field(octree(cube, from.array<std::uint32_t>()));
  field.values_ = from.array<double>();
  field.options_.slope = from.value<double>();
  field.error_ = from.value<double>();
  field.smallest_ = from.value<double>();
  field.number_corners();
  if (field.values_.size() != field.points_.size())
    throw input_error("a gradation has " + std::to_string(field.values_.size()) + " values at " +
                      std::to_string(field.points_.size()) + " corners; its data are damaged");
  field.finish();
  return field;
}

DOVETAIL_INLINE double graded_size::operator()(vec3 p) const {
  const box3& domain = tree_.bounds();
  const vec3 q{std::clamp(p.x, domain.lower.x, domain.upper.x),
               std::clamp(p.y, domain.lower.y, domain.upper.y),
               std::clamp(p.z, domain.lower.z, domain.upper.z)};
  return interpolated(tree_.locate(q), q) + options_.slope * distance(p, q);
}

DOVETAIL_INLINE double graded_size::smallest_size_in(const box3& box) const {
  const double radius = 0.5 * box.diagonal();
  // A trilinear interpolant of values with this slope along the edges has at most this gradient.
  const double steepest = std::sqrt(3.0) * options_.slope;
  const double least = least_in(box);
  if (least == std::numeric_limits<double>::infinity()) // wholly outside
    return std::max(smallest_, (*this)(box.center()) - steepest * radius);
  return least;
}

DOVETAIL_INLINE box3 graded_size::checked(const box3& domain, const gradation_options& options) {
  sizing::checked_size(options.slope, "the gradation slope");
  sizing::checked_size(options.relative_error, "the error of the gradation");
  sizing::checked_point(domain.lower, "the domain of the gradation");
  sizing::checked_point(domain.upper, "the domain of the gradation");
  if (domain.empty() || !(domain.diagonal() > 0))
    throw sizing_error("the domain of the gradation is empty; give the model's box");
  return cube_around(domain);
}

DOVETAIL_INLINE void graded_size::number_corners() {
  struct corner_key {
    std::array<std::uint32_t, 3> at;
    std::uint32_t leaf;
    std::uint32_t which;
  };
  std::vector<corner_key> keys;
  keys.reserve(8 * tree_.leaf_count());
  for (std::uint32_t leaf = 0; leaf < tree_.leaf_count(); ++leaf)
    for (std::uint32_t k = 0; k < 8; ++k)
      keys.push_back({tree_.corner_key(tree_.leaf(leaf), k), leaf, k});
  sort_all(keys, [](const corner_key& a, const corner_key& b) {
    return std::tie(a.at, a.leaf, a.which) < std::tie(b.at, b.leaf, b.which);
  });
  corners_.assign(tree_.leaf_count(), {});
  points_.clear();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || keys[i].at != keys[i - 1].at)
      points_.push_back(tree_.corner_point(keys[i].at));
    corners_[keys[i].leaf][keys[i].which] = static_cast<std::uint32_t>(points_.size() - 1);
  }
}

DOVETAIL_INLINE void graded_size::offer(std::size_t leaf, const origin& o) {
  bool taken = false;
  for (const std::uint32_t corner : corners_[leaf]) {
    const double value = value_from(o, points_[corner]);
    if (value < values_[corner]) {
      values_[corner] = value;
      origin_of_[corner] = static_cast<std::uint32_t>(origins_.size());
      taken = true;
    }
  }
  if (taken)
    origins_.push_back(o);
}

DOVETAIL_INLINE void graded_size::propagate() {
  const auto leaves_of = leaves_around_corners();
  using entry = std::pair<double, std::uint32_t>;
  std::priority_queue<entry, std::vector<entry>, std::greater<>> queue;
  for (std::uint32_t i = 0; i < values_.size(); ++i)
    queue.emplace(values_[i], i);
  while (!queue.empty()) {
    const auto [value, from] = queue.top();
    queue.pop();
    if (value > values_[from])
      continue;
    const origin& o = origins_[origin_of_[from]];
    for (const std::uint32_t leaf : leaves_of[from])
      for (const std::uint32_t to : corners_[leaf]) {
        const double candidate = value_from(o, points_[to]);
        if (candidate < values_[to]) {
          values_[to] = candidate;
          origin_of_[to] = origin_of_[from];
          queue.emplace(candidate, to);
        }
      }
  }
}

DOVETAIL_INLINE compressed_rows<std::uint32_t> graded_size::leaves_around_corners() const {
  return sorted_into_rows<std::uint32_t>(points_.size(), [&](const auto& put) {
    for (std::uint32_t leaf = 0; leaf < corners_.size(); ++leaf)
      for (const std::uint32_t corner : corners_[leaf])
        put(corner, leaf);
  });
}

DOVETAIL_INLINE void graded_size::finish() {
  points_ = {};
  raw_ = {};
  origins_ = {};
  origin_of_ = {};
  find_least_values();
}

} // namespace dovetail
