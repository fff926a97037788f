/// @file
/// A field from sizes at many points: cones of limited growth around each.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/bytes.hpp"
#include "dovetail/sizing/bounds.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail {

/// A place and the size wanted there.
struct sized_point {
  vec3 point;      ///< where the size is wanted
  double size = 0; ///< the edge length wanted
};

/// h(x) = min(largest, min over points p of size(p) + growth |x - p|). Its growth is limited by
/// construction. Evaluated through a tree of boxes that know their smallest size, about log n steps; copies
/// share it. Points that change nothing are dropped when it is made. Throws `sizing_error`
/// for a size, growth or largest size that is not positive and finite.
class point_sizes {
public:
  point_sizes(std::vector<sized_point> points, double growth, double largest);

  /// The points that change something, by their places, for another process: the same field, the same bytes.
  void encode(byte_writer& to) const;
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
    tree(std::vector<sized_point> points, double growth);

    const std::vector<sized_point>& points() const { return points_; }
    double value(vec3 p, double bound) const { return least_in({p, p}, bound); }
    double least_in(const box3& box, double bound) const;
    /// Whether a smaller point's cone lies below this one's everywhere.
    bool is_covered(const sized_point& p) const;

  private:
    static constexpr std::size_t leaf_size = 6;

    const sized_point& at(local_id k) const { return points_[k]; }
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

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/point_sizes.ipp"
#endif
