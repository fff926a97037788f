/// @file
/// Points of a body-centred cubic lattice that grows from seeds and stretches with the size.
#pragma once

#include "dovetail/core/scattered.hpp"
#include "dovetail/mesher/native/interior_point_options.hpp"
#include "dovetail/mesher/native/piece_octree.hpp"
#include "dovetail/mesher/native/point_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace dovetail::detail {

/// Each point expects its eight nearest neighbours at half the diagonals of a cell as large as the size half
/// way says. What is expected first becomes a point, unless another is too close, at the mean of what all its
/// neighbours expect, and has expectations in turn. So on a uniform field the lattice is perfect, and on
/// others it is bent rather than broken: a fifth as many slivers come of it as of points thrown at random.
/// Small sizes go first, for points that are too many are thinned, and points that are too few leave gaps.
///
/// One object makes the points of one piece: `grow()`, then `take()`. About constant time per point.
class lattice_growth {
public:
  lattice_growth(const piece_octree& piece, const interior_point_options& options)
      : piece_(piece), options_(options), grid_(piece, neighbourhood * options.cell) {
    sort_leaves();
    queues_.resize(leaves_by_class_.size());
  }

  void grow() {
    for (std::size_t c = 0; c < leaves_by_class_.size(); ++c)
      for (const std::uint32_t leaf : leaves_by_class_[c]) {
        seed(leaf);
        spread(c);
      }
  }

  std::vector<vec3> take() const {
    std::vector<vec3> points;
    points.reserve(points_.size());
    for (const grown_point& one : points_)
      points.push_back(one.place);
    return points;
  }

private:
  static constexpr double neighbourhood = 1.3; ///< in cells: the nearest 14, of which the farthest are at 1

  struct grown_point {
    vec3 place;
    double size;
    std::uint32_t leaf;
    std::uint8_t settled = 0; ///< bit k: nothing is to be done any more in direction k
  };
  struct queue {
    std::vector<std::uint32_t> points;
    std::size_t done = 0;
  };
  /// A place in the piece.
  struct spot {
    vec3 place;
    std::size_t leaf;
    double size;
  };

  static vec3 direction(unsigned k) {
    return {(k & 1U) != 0 ? 0.5 : -0.5, (k & 2U) != 0 ? 0.5 : -0.5, (k & 4U) != 0 ? 0.5 : -0.5};
  }

  /// Sizes in a class differ by less than a factor of two.
  std::size_t class_of(double size) const {
    const double above = std::log2(size / least_size_);
    return std::min(static_cast<std::size_t>(std::max(above, 0.0)), leaves_by_class_.size() - 1);
  }
  void sort_leaves() {
    const octree& tree = piece_.tree();
    least_size_ = std::numeric_limits<double>::infinity();
    double greatest = 0;
    for (std::size_t k = 0; k < tree.leaf_count(); ++k)
      if (const std::size_t leaf = tree.leaf(k); !piece_.is_outside(leaf)) {
        least_size_ = std::min(least_size_, piece_.least_size(leaf));
        greatest = std::max(greatest, piece_.greatest_size(leaf));
      }
    if (!(greatest > 0))
      return;
    leaves_by_class_.resize(static_cast<std::size_t>(std::log2(greatest / least_size_)) + 1);
    for (std::size_t k = 0; k < tree.leaf_count(); ++k)
      if (const std::size_t leaf = tree.leaf(k); !piece_.is_outside(leaf))
        leaves_by_class_[class_of(piece_.least_size(leaf))].push_back(static_cast<std::uint32_t>(leaf));
  }

  std::optional<spot> find(vec3 place) const {
    const octree& tree = piece_.tree();
    if (!contains(tree.bounds(), place))
      return std::nullopt;
    const std::size_t leaf = tree.locate(place);
    if (piece_.is_outside(leaf))
      return std::nullopt;
    return spot{place, leaf, piece_.size_at(leaf, place)};
  }

  /// In the middle of a leaf with no point in it nor near: where growth has not come and may begin.
  void seed(std::uint32_t leaf) {
    if (grid_.has_points(leaf))
      return;
    const vec3 middle = piece_.tree().box(leaf).center();
    const spot at{middle, leaf, piece_.size_at(leaf, middle)};
    grid_.gather(leaf, middle, options_.cell * at.size, 0, gathered_);
    if (gathered_.empty() && is_free(at))
      add(at);
  }

  /// Until all points of this class and of smaller ones have their neighbours.
  void spread(std::size_t last_class) {
    lowest_ = 0;
    while (lowest_ <= last_class) {
      queue& waiting = queues_[lowest_];
      if (waiting.done < waiting.points.size()) {
        surround(waiting.points[waiting.done++]);
      } else {
        waiting = {};
        ++lowest_;
      }
    }
  }

  /// Makes the neighbours of a point that it still expects.
  void surround(std::uint32_t at) {
    for (unsigned k = 0; k < 8; ++k) {
      const grown_point& from = points_[at];
      if ((from.settled >> k & 1U) != 0)
        continue;
      const auto reached = find(from.place + options_.cell * from.size * direction(k));
      // The size half way, when sizes are linear in between.
      if (reached)
        settle(from.place + 0.5 * options_.cell * (from.size + reached->size) * direction(k));
    }
  }

  /// Makes a point at the mean of what is expected around a place, if it may be there.
  void settle(vec3 place) {
    auto at = find(place);
    if (!at)
      return;
    if (!grid_.gather(at->leaf, place, neighbourhood * options_.cell * at->size, options_.crowding * at->size,
                      gathered_))
      return;
    at = find(mean_expectation(*at));
    if (!at || is_crowded(*at))
      return;
    const std::uint8_t met = meet_expectations(*at);
    if (is_free(*at))
      add(*at, met);
  }

  bool is_free(const spot& at) const {
    const auto shares_clear_space = [&](const gathered_point& one) {
      const double both = options_.clearance * (at.size + one.size);
      return norm_squared(one.place - at.place) < both * both;
    };
    return piece_.is_clear(at.leaf, at.place, options_.clearance * at.size) &&
           (std::any_of(gathered_.begin(), gathered_.end(), shares_clear_space) ||
            piece_.is_inside(at.leaf, at.place));
  }

  bool is_crowded(const spot& at) const {
    const double radius = options_.crowding * at.size;
    return std::any_of(gathered_.begin(), gathered_.end(), [&](const gathered_point& one) {
      return norm_squared(one.place - at.place) < radius * radius;
    });
  }

  /// Calls `use(gathered, vector, place)` for neighbours that expect a point close to `at`.
  template <class Use>
  void for_each_expectation(const spot& at, Use&& use) const {
    const double capture = options_.capture * at.size;
    for (const gathered_point& one : gathered_) {
      const double cell = 0.5 * options_.cell * (at.size + one.size);
      const vec3 vector = nearest_lattice_vector((at.place - one.place) / cell);
      const vec3 expected = one.place + cell * vector;
      if (norm_squared(expected - at.place) < capture * capture)
        use(one, vector, expected);
    }
  }
  vec3 mean_expectation(const spot& at) const {
    vec3 sum = at.place;
    double count = 1;
    for_each_expectation(at, [&](const gathered_point&, vec3, vec3 expected) {
      sum += expected;
      count += 1;
    });
    return sum / count + options_.jitter * at.size * scattered_vector(points_.size());
  }
  /// What neighbours expect here is here, or cannot be: they need not try. Returns the directions in which
  /// they are.
  std::uint8_t meet_expectations(const spot& at) {
    unsigned met = 0;
    for_each_expectation(at, [&](const gathered_point& one, vec3 vector, vec3) {
      if (std::abs(vector.x) != 0.5 || std::abs(vector.y) != 0.5 || std::abs(vector.z) != 0.5)
        return;
      const unsigned k = (vector.x > 0 ? 1U : 0U) | (vector.y > 0 ? 2U : 0U) | (vector.z > 0 ? 4U : 0U);
      points_[one.id].settled = static_cast<std::uint8_t>(points_[one.id].settled | 1U << k);
      met |= 1U << (7 - k);
    });
    return static_cast<std::uint8_t>(met);
  }
  /// Of the lattice of corners and centres of unit cubes; within a few cells of the origin.
  static vec3 nearest_lattice_vector(vec3 v) {
    const auto rounded = [](double x) { return static_cast<double>(static_cast<int>(x + 16.5) - 16); };
    const auto centered = [](double x) { return static_cast<double>(static_cast<int>(x + 16) - 16) + 0.5; };
    const vec3 corner{rounded(v.x), rounded(v.y), rounded(v.z)};
    const vec3 center{centered(v.x), centered(v.y), centered(v.z)};
    return norm_squared(v - corner) < norm_squared(v - center) ? corner : center;
  }

  void add(const spot& at, std::uint8_t settled = 0) {
    if (static_cast<double>(points_.size()) >= options_.most_points)
      throw_too_many_points(options_.most_points);
    const auto id = static_cast<std::uint32_t>(points_.size());
    points_.push_back({at.place, at.size, static_cast<std::uint32_t>(at.leaf), settled});
    grid_.add(at.leaf, at.place, at.size);
    const std::size_t c = class_of(at.size);
    queues_[c].points.push_back(id);
    lowest_ = std::min(lowest_, c);
  }

  const piece_octree& piece_;
  interior_point_options options_;
  point_grid grid_;
  double least_size_ = 0;
  std::vector<std::vector<std::uint32_t>> leaves_by_class_;
  std::vector<queue> queues_; ///< per class of sizes: points whose neighbours are to be made
  std::size_t lowest_ = 0;    ///< no point of a lower class waits
  std::vector<grown_point> points_;
  std::vector<gathered_point> gathered_;
};

} // namespace dovetail::detail
