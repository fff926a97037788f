/// @file
/// Limited growth: the largest field below a given one whose size grows by at most a slope per length,
/// h*(x) = min over y of h(y) + slope |x - y|, precomputed on an octree.
///
/// Every corner of the octree carries the place y its value comes from, so that distances are straight lines
/// through space and not along the octree's edges (the idea of vector distance propagation, P.-E. Danielsson,
/// Comput. Graph. Image Process. 14 (1980) 227-248, driven by a priority queue as in Dijkstra's algorithm).
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/octree_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace dovetail {

/// How much and how exactly growth is limited.
struct gradation_options {
  double slope = 0.25;                    ///< growth of the size per length; above 0
  double relative_error = 0.10;           ///< estimated in every leaf
  std::size_t largest_leaves = 2'000'000; ///< stop refining there; `error_bound()` tells what was reached
};

/// A field with limited growth inside a domain; outside it, the value at the nearest point of the domain plus
/// slope times the distance. Evaluated in O(depth) by trilinear interpolation, without calling the original
/// field. Building costs about 20 evaluations of the original field per leaf; leaves are at most about twice
/// as wide as the size in them. A source between the samples is seen through the field's `smallest_size_in`.
/// Throws `sizing_error` for a slope that is not positive, an empty domain, or a field whose value is not a
/// positive, finite number.
class graded_size : private sizing::octree_values {
public:
  template <class H>
  graded_size(const H& field, const box3& domain, const gradation_options& options = {})
      : octree_values(checked(domain, options)), options_(options) {
    static_assert(sizing_field<H>, "graded_size takes a sizing_field (sizing/concepts.hpp)");
    refine_to_sizes(field);
    for (int round = 0;; ++round) {
      collect_corners(field);
      propagate();
      const auto coarse = leaves_off_by_more(field);
      if (coarse.empty() || round == largest_rounds || tree_.leaf_count() > options_.largest_leaves)
        break;
      for (const std::size_t leaf : coarse)
        tree_.split(leaf);
    }
    finish();
  }

  /// The octree and the values at its corners, 4 and about 12 bytes per leaf, for a process that need not
  /// have the original field then.
  void encode(byte_writer& to) const;
  /// The same field bit for bit. O(n log n). Throws `input_error` when the data are damaged.
  static graded_size decode(byte_reader& from);

  double operator()(vec3 p) const;

  /// The smallest corner value among the leaves that meet the box, or, where it is sharper, its centre's
  /// value less what the slope allows.
  double smallest_size_in(const box3& box) const;

  double slope() const { return options_.slope; } ///< growth of the size per length
  /// The largest relative error estimated in any leaf: interpolation, and where values start between the
  /// samples.
  double error_bound() const { return error_; }
  using octree_values::leaf_count;

private:
  explicit graded_size(octree tree) : octree_values(tree.bounds()) { tree_ = std::move(tree); }

  static constexpr int largest_rounds = 8;
  static constexpr double width_per_size = 4; // of a leaf, to begin with

  static box3 checked(const box3& domain, const gradation_options& options);

  /// What the field may be as small as in a box: its bound, and samples at the centre.
  template <sizing_field H>
  static double least_of(const H& field, const box3& box) {
    const double bound = dovetail::smallest_size_in(field, box);
    const double sample = dovetail::checked_size(field, box.center());
    return bound > 0 ? bound : sample;
  }

  /// Splits leaves wider than a few sizes. Without a bound from the field, at least 32 leaves across the
  /// domain.
  template <sizing_field H>
  void refine_to_sizes(const H& field) {
    const double widest = (tree_.bounds().upper.x - tree_.bounds().lower.x) / 32;
    tree_.refine([&](const box3& box) {
      if (tree_.leaf_count() > options_.largest_leaves)
        return false;
      const double width = box.upper.x - box.lower.x;
      const bool bounded = dovetail::smallest_size_in(field, box) > 0;
      return width > width_per_size * least_of(field, box) || (!bounded && width > widest);
    });
  }

  /// Numbers the corners of the leaves, by their places.
  void number_corners();

  /// Gives each corner the field's value there, or what the bound in a leaf allows.
  template <sizing_field H>
  void collect_corners(const H& field) {
    number_corners();
    values_.clear();
    for (const vec3 p : points_)
      values_.push_back(dovetail::checked_size(field, p));
    raw_ = values_;
    seed_origins(field);
  }

  /// Places that values may come from: every corner, and in every leaf its centre, and a smaller value that
  /// only the bound shows (taken at the centre: off by at most half the leaf's diagonal).
  template <sizing_field H>
  void seed_origins(const H& field) {
    origins_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i)
      origins_.push_back({points_[i], values_[i]});
    origin_of_.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i)
      origin_of_[i] = static_cast<std::uint32_t>(i);
    for (std::size_t leaf = 0; leaf < tree_.leaf_count(); ++leaf) {
      const box3 box = tree_.box(tree_.leaf(leaf));
      double least = static_cast<double>(field(box.center()));
      const double bound = dovetail::smallest_size_in(field, box);
      if (bound > 0)
        least = std::min(least, bound + 0.25 * options_.slope * box.diagonal());
      offer(leaf, {box.center(), least});
    }
  }

  struct origin {
    vec3 point;
    double size;
  };

  double value_from(const origin& o, vec3 p) const { return o.size + options_.slope * distance(o.point, p); }

  /// Lets the corners of a leaf take their values from a new origin where that is smaller.
  void offer(std::size_t leaf, const origin& o);

  /// Smallest values first, each corner hands its origin to the other corners of its leaves.
  void propagate();

  compressed_rows<std::uint32_t> leaves_around_corners() const;

  /// Leaves whose error estimate is above the one asked for; also sets `error_` and `smallest_`.
  template <sizing_field H>
  std::vector<std::size_t> leaves_off_by_more(const H& field) {
    std::vector<std::size_t> coarse;
    error_ = 0;
    smallest_ = *std::min_element(values_.begin(), values_.end());
    for (std::size_t index = 0; index < tree_.leaf_count(); ++index) {
      const double error = std::max(interpolation_error(index, field), origin_error(index, field));
      error_ = std::max(error_, error);
      if (error > options_.relative_error)
        coarse.push_back(tree_.leaf(index));
    }
    return coarse;
  }

  /// Largest relative difference, at the centres of a leaf, its faces and its edges, from what the corners'
  /// origins and (at the leaf's centre) the field itself give there.
  template <sizing_field H>
  double interpolation_error(std::size_t index, const H& field) const {
    const std::size_t leaf = tree_.leaf(index);
    const box3 box = tree_.box(leaf);
    const vec3 half = 0.5 * (box.upper - box.lower);
    const bool all_limited =
        std::all_of(corners_[index].begin(), corners_[index].end(),
                    [&](std::uint32_t corner) { return values_[corner] < raw_[corner]; });
    double worst = 0;
    for (int k = 0; k < 27; ++k) {
      const std::array<int, 3> at{k % 3, k / 3 % 3, k / 9};
      if (at[0] != 1 && at[1] != 1 && at[2] != 1) // a corner
        continue;
      const vec3 p = box.lower + vec3{at[0] * half.x, at[1] * half.y, at[2] * half.z};
      double exact = k == 13 ? static_cast<double>(field(p)) : std::numeric_limits<double>::infinity();
      for (const std::uint32_t corner : corners_[index])
        exact = std::min(exact, value_from(origins_[origin_of_[corner]], p));
      const double value = interpolated(leaf, p);
      // Below the cones of the corners the field itself may rule: only where none of the corners keeps it is
      // that an error.
      if (k == 13 || value > exact || all_limited)
        worst = std::max(worst, std::abs(value - exact) / exact);
    }
    return worst;
  }

  /// Where the field itself is the limit at one corner and too steep at another, values start from somewhere
  /// between the samples, so they are off by up to the slope times half the leaf's width; so are they where
  /// the field's bound allows a size below all samples.
  template <sizing_field H>
  double origin_error(std::size_t index, const H& field) const {
    const box3 box = tree_.box(tree_.leaf(index));
    double least = std::numeric_limits<double>::infinity();
    double sampled = static_cast<double>(field(box.center()));
    bool kept = false;
    bool limited = false;
    for (const std::uint32_t corner : corners_[index]) {
      least = std::min(least, values_[corner]);
      sampled = std::min(sampled, raw_[corner]);
      kept = kept || raw_[corner] <= values_[corner] * (1 + 1e-9);
      limited = limited || raw_[corner] > values_[corner] * (1 + 0.5 * options_.relative_error);
    }
    const double bound = dovetail::smallest_size_in(field, box);
    const bool hidden = bound > 0 && bound <= least && bound < sampled * (1 - options_.relative_error);
    if (!hidden && !(kept && limited))
      return 0;
    return 0.5 * options_.slope * (box.upper.x - box.lower.x) / (hidden ? bound : least);
  }

  void finish();

  gradation_options options_;
  double error_ = 0;
  double smallest_ = 0;
  // While building:
  std::vector<vec3> points_;
  std::vector<double> raw_; ///< the field itself at the corners
  std::vector<origin> origins_;
  std::vector<std::uint32_t> origin_of_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/graded.ipp"
#endif
