/// @file
/// A field from sizes at many points: cones of limited growth around each.
#pragma once

#include "dovetail/core/median_tree.hpp"
#include "dovetail/sizing/bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail {

/// A place and the size wanted there.
struct sized_point {
  vec3 point;
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

  double operator()(vec3 p) const { return tree_->value(p, largest_); }
  double smallest_size_in(const box3& box) const { return tree_->least_in(box, largest_); }
  double feature_size(vec3) const { return std::numeric_limits<double>::infinity(); }

  std::size_t size() const { return tree_->points().size(); }
  double growth() const { return growth_; }
  double largest() const { return largest_; }

private:
  class tree {
  public:
    tree(std::vector<sized_point> points, double growth)
        : points_(std::move(points)), nodes_(build_median_tree<node>(points_, leaf_size, point_of)),
          growth_(growth) {}

    const std::vector<sized_point>& points() const { return points_; }
    double value(vec3 p, double bound) const { return nodes_.empty() ? bound : visit(0, box3{p, p}, bound); }
    double least_in(const box3& box, double bound) const {
      return nodes_.empty() ? bound : visit(0, box, bound);
    }
    /// Whether a smaller point's cone lies below this one's everywhere.
    bool is_covered(const sized_point& p) const { return covered(0, p); }

  private:
    struct node : median_node {
      double size = std::numeric_limits<double>::infinity(); ///< smallest below

      void include(const sized_point& p) { size = std::min(size, p.size); }
    };
    static constexpr std::size_t leaf_size = 6;
    static constexpr auto point_of = [](const sized_point& p) { return p.point; };

    static double gap(const box3& a, const box3& b) {
      double squared = 0;
      for (int k = 0; k < 3; ++k) {
        const double out = std::max({a.lower[k] - b.upper[k], 0.0, b.lower[k] - a.upper[k]});
        squared += out * out;
      }
      return std::sqrt(squared);
    }
    double least_from(const node& n, const box3& box) const { return n.size + growth_ * gap(n.box, box); }

    double visit(std::size_t id, const box3& box, double bound) const {
      const node& n = nodes_[id];
      if (least_from(n, box) >= bound)
        return bound;
      if (n.is_leaf()) {
        for (std::size_t i = n.first; i < n.last; ++i)
          bound = std::min(bound, points_[i].size + growth_ * gap({points_[i].point, points_[i].point}, box));
        return bound;
      }
      std::size_t near = id + 1;
      std::size_t far = n.right;
      if (least_from(nodes_[far], box) < least_from(nodes_[near], box))
        std::swap(near, far);
      return visit(far, box, visit(near, box, bound));
    }

    bool covered(std::size_t id, const sized_point& p) const {
      const node& n = nodes_[id];
      if (n.size >= p.size || least_from(n, {p.point, p.point}) > p.size)
        return false;
      if (!n.is_leaf())
        return covered(id + 1, p) || covered(n.right, p);
      for (std::size_t i = n.first; i < n.last; ++i)
        if (points_[i].size < p.size &&
            points_[i].size + growth_ * distance(points_[i].point, p.point) <= p.size)
          return true;
      return false;
    }

    std::vector<sized_point> points_;
    std::vector<node> nodes_;
    double growth_;
  };

  double growth_;
  double largest_;
  std::shared_ptr<const tree> tree_;
};

} // namespace dovetail
