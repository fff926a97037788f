/// @file
/// What `point_sizes.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/bytes.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/sizing/bounds.hpp"
#include "dovetail/sizing/point_sizes.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE point_sizes::point_sizes(std::vector<sized_point> points, double growth, double largest)
    : growth_(sizing::checked_size(growth, "the growth of the sizes")),
      largest_(sizing::checked_size(largest, "the largest size")) {
  for (const sized_point& p : points) {
    sizing::checked_size(p.size, "the size at a point");
    sizing::checked_point(p.point, "a point with a size");
  }
  auto all = tree(std::move(points), growth_);
  std::vector<sized_point> needed;
  for (const sized_point& p : all.points())
    if (p.size < largest_ && !all.is_covered(p))
      needed.push_back(p);
  tree_ = std::make_shared<const tree>(std::move(needed), growth_);
}

DOVETAIL_INLINE void point_sizes::encode(byte_writer& to) const {
  auto points = tree_->points();
  sort_all(points, [](const sized_point& a, const sized_point& b) {
    return std::tie(a.point.x, a.point.y, a.point.z, a.size) <
           std::tie(b.point.x, b.point.y, b.point.z, b.size);
  });
  to.array(points);
  to.value(growth_);
  to.value(largest_);
}

DOVETAIL_INLINE point_sizes::tree::tree(std::vector<sized_point> points, double growth)
    : points_(std::move(points)),
      tree_(boxes_of_points(points_, [](const sized_point& p) { return p.point; }), leaf_size),
      growth_(growth) {
  tree_.put_in_order(points_);
  sizes_ = tree_.reduce<double>([this](local_id k) { return at(k).size; },
                                [](double a, double b) { return std::min(a, b); });
}

DOVETAIL_INLINE double point_sizes::tree::least_in(const box3& box, double bound) const {
  return tree_.least(
      bound, [&](std::size_t id) { return least_from(id, box); },
      [&](local_id k) {
        return at(k).size + growth_ * distance({at(k).point, at(k).point}, box);
      });
}

DOVETAIL_INLINE bool point_sizes::tree::is_covered(const sized_point& p) const {
  bool covered = false;
  tree_.for_each(
      [&](const box3&, std::size_t id) {
        return !covered && sizes_[id] < p.size && least_from(id, {p.point, p.point}) <= p.size;
      },
      [&](local_id k) {
        covered = covered ||
                  (at(k).size < p.size && at(k).size + growth_ * distance(at(k).point, p.point) <= p.size);
      });
  return covered;
}

} // namespace dovetail
