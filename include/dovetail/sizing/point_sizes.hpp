/// @file
/// A field from sizes at many points: cones of limited growth around each.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/bytes.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/sizing/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

/// A place and the size wanted there.
struct sized_point {
  vec3 point; ///< where the size is wanted
  double size = 0;
};

/// h(x) = min(largest, min over points p of size(p) + growth |x - p|). Its growth is limited by
/// construction. Evaluated through a tree of boxes that know their smallest size, about log n steps; copies
/// share it. Points that change nothing are dropped when it is made. Throws `sizing_error`
/// for a size, growth or largest size that is not positive and finite.
class point_sizes {
public:
  point_sizes(std::vector<sized_point> points, double growth, double largest)
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

  /// The points that change something, by their places, for another process: the same field, the same bytes.
  void encode(byte_writer& to) const {
    auto points = tree_->points();
    sort_all(points, [](const sized_point& a, const sized_point& b) {
      return std::tie(a.point.x, a.point.y, a.point.z, a.size) <
             std::tie(b.point.x, b.point.y, b.point.z, b.size);
    });
    to.array(points);
    to.value(growth_);
    to.value(largest_);
  }
  /// The same field bit for bit, at the cost of building it. Throws `input_error` when the data end early.
  static point_sizes decode(byte_reader& from) {
    auto points = from.array<sized_point>();
    const auto growth = from.value<double>();
    return {std::move(points), growth, from.value<double>()};
  }

  double operator()(vec3 p) const { return tree_->value(p, largest_); }
  double smallest_size_in(const box3& box) const { return tree_->least_in(box, largest_); }
  double feature_size(vec3) const { return std::numeric_limits<double>::infinity(); }

  std::size_t size() const { return tree_->points().size(); }
  double growth() const { return growth_; }   ///< of the size per length
  double largest() const { return largest_; } ///< the size where no point is near

private:
  class tree {
  public:
    tree(std::vector<sized_point> points, double growth)
        : points_(std::move(points)),
          tree_(boxes_of_points(points_, [](const sized_point& p) { return p.point; }), leaf_size),
          growth_(growth) {
      tree_.put_in_order(points_);
      sizes_ = tree_.reduce<double>([this](local_id k) { return at(k).size; },
                                    [](double a, double b) { return std::min(a, b); });
    }

    const std::vector<sized_point>& points() const { return points_; }
    double value(vec3 p, double bound) const { return least_in({p, p}, bound); }
    double least_in(const box3& box, double bound) const {
      return tree_.least(
          bound, [&](std::size_t id) { return least_from(id, box); },
          [&](local_id k) {
            return at(k).size + growth_ * distance({at(k).point, at(k).point}, box);
          });
    }
    /// Whether a smaller point's cone lies below this one's everywhere.
    bool is_covered(const sized_point& p) const {
      bool covered = false;
      tree_.for_each(
          [&](const box3&, std::size_t id) {
            return !covered && sizes_[id] < p.size && least_from(id, {p.point, p.point}) <= p.size;
          },
          [&](local_id k) {
            covered = covered || (at(k).size < p.size &&
                                  at(k).size + growth_ * distance(at(k).point, p.point) <= p.size);
          });
      return covered;
    }

  private:
    static constexpr std::size_t leaf_size = 6;

    const sized_point& at(local_id k) const { return points_[static_cast<std::size_t>(k)]; }
    double least_from(std::size_t id, const box3& box) const {
      return sizes_[id] + growth_ * distance(tree_.box(id), box);
    }

    std::vector<sized_point> points_;
    box_tree tree_;
    std::vector<double> sizes_; ///< per node: the smallest below
    double growth_;
  };

  double growth_;
  double largest_;
  std::shared_ptr<const tree> tree_;
};

} // namespace dovetail
