/// @file
/// Splits a side of a poor triangle, lets the new vertex settle, and takes all back when that does not help.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/triangles/operation_limits.hpp"
#include "dovetail/mesh/surface_smoothing.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace dovetail::improvement {

/// The operation that splits a side of a triangle.
class side_insertion {
public:
  static constexpr std::array names{"insertion"}; ///< for reports
  static constexpr turn when = turn::hard;        ///< it is tried in the sweeps with hard operations

  explicit side_insertion(surface_complex& mesh) : s_(mesh), smooth_(mesh) {}

  /// Tries the sides of `t`, the longest first.
  bool mend(surface_complex& mesh, local_id t, const operation_limits<2>& limits,
            const recorded_tries& tries) {
    std::array<std::pair<double, local_id>, 3> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      const local_id c = 3 * t + static_cast<local_id>(k);
      sides[k] = {-mesh.length(mesh.table.tail(c), mesh.table.head(c)), c};
    }
    sort_all(sides);
    for (const auto& side : sides) {
      const local_id c = side.second;
      const local_id v = mesh.table.tail(c), w = mesh.table.head(c);
      if (mesh.table.free_side(c) && tries([&] { return improve(c, limits.target, limits.least_step); }))
        return true;
      // An attempt that was taken back may have renamed the corners of t.
      if (!mesh.table.alive(t) || mesh.table.tail(c) != v || mesh.table.head(c) != w)
        return false;
    }
    return false;
  }

  /// Splits the free side opposite c. Kept when, after flips of the sides around the new vertex and moves,
  /// the worst triangle around it is better than the worse of the two that were split by more than
  /// `least_gain`, and all together lack less of `target` than those they replace (else one poor triangle
  /// would become several). Only triangles that have the new vertex change: the others cannot get worse.
  bool improve(local_id c, double target, double least_gain) {
    const local_id d = s_.table.twin[c];
    const double q = s_.quality(corner_table::triangle_of(c)), r = s_.quality(corner_table::triangle_of(d));
    const local_id tail = s_.table.tail(c);
    const local_id v = s_.add_middle(c);
    if (v == no_id)
      return false;
    s_.table.split_side(c, v);
    target_ = target;
    lacked_ = lack_of(q) + lack_of(r);
    flipped_.clear();
    for (int round = 0; round < rounds; ++round) {
      const bool is_flipped = flip_around(v);
      const bool is_moved = smooth_.maximise_worst(v);
      if (!is_flipped && !is_moved)
        break;
    }
    double worst = 1, lack = 0;
    s_.table.for_each_corner(v, [&](local_id at) {
      const double quality = s_.quality(corner_table::triangle_of(at));
      worst = std::min(worst, quality);
      lack += lack_of(quality);
    });
    if (worst > std::min(q, r) + least_gain && lack < lacked_)
      return true;
    take_back(v, tail);
    return false;
  }

private:
  static constexpr int rounds = 4, largest_valence = 12;

  /// Flips sides opposite v as long as that raises the worse of their triangles.
  bool flip_around(local_id v) {
    int valence = 0;
    s_.table.for_each_corner(v, [&](local_id) { ++valence; });
    bool any = false;
    for (bool again = true; again && valence < largest_valence;) {
      again = false;
      const local_id first = s_.table.corner_of[v];
      local_id c = first;
      do {
        if (s_.table.free_side(c) && dovetail::detail::flip_queue::flip_raises_quality(s_, c) &&
            s_.may_flip(c)) {
          const local_id d = s_.table.twin[c];
          flipped_.push_back(s_.table.vertex[d]);
          lacked_ += lack_of(s_.quality(corner_table::triangle_of(d)));
          s_.table.flip(c);
          ++valence;
          any = again = true;
          break;
        }
        c = s_.table.counter_clockwise(c);
      } while (c != first);
    }
    return any;
  }

  /// Undoes flips, then the split: v goes back onto the tail of the side it split.
  void take_back(local_id v, local_id tail) {
    for (std::size_t i = flipped_.size(); i-- > 0;)
      s_.table.flip(corner_facing(v, flipped_[i]));
    s_.table.collapse(corner_facing(v, tail));
    s_.drop_last_vertex();
  }
  /// The corner whose opposite side runs from v to w.
  local_id corner_facing(local_id v, local_id w) const {
    local_id facing = no_id;
    s_.table.for_each_corner(v, [&](local_id c) {
      if (s_.table.tail(c) == w)
        facing = corner_table::previous(c);
    });
    return facing;
  }

  double lack_of(double quality) const { return std::max(target_ - quality, 0.0); }

  surface_complex& s_;
  dovetail::detail::smoother<surface_complex> smooth_;
  double target_ = 0;
  double lacked_ = 0;             ///< by the triangles that are replaced
  std::vector<local_id> flipped_; ///< the far ends of the edges that flips gave to v
};

} // namespace dovetail::improvement
