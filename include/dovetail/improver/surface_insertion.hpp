/// @file
/// Splits a side of a poor triangle, lets the new vertex settle, and takes all back when that does not help.
#pragma once

#include "dovetail/mesh/surface_smoothing.hpp"

#include <algorithm>
#include <vector>

namespace dovetail::improvement {

/// Vertex insertion for a state of mesh/surface_operations.hpp that can drop its last vertex.
template <class State>
class surface_insertion {
public:
  surface_insertion(State& state, dovetail::detail::smoother<State>& smooth) : s_(state), smooth_(smooth) {}

  /// Splits the free side opposite c. Kept when, after flips of the sides around the new vertex and moves,
  /// the worst triangle around it is better than the worse of the two that were split by more than
  /// `least_gain`, and all together lack less of `target` than those they replace (else one poor triangle
  /// would become several). Only triangles that have the new vertex change: the others cannot get worse.
  bool improve(local_id c, double target, double least_gain) {
    const local_id d = s_.table.twin[s_.at(c)];
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
      const local_id first = s_.table.corner_of[s_.at(v)];
      local_id c = first;
      do {
        if (s_.table.free_side(c) && dovetail::detail::flip_queue::flip_raises_quality(s_, c) &&
            s_.may_flip(c)) {
          const local_id d = s_.table.twin[s_.at(c)];
          flipped_.push_back(s_.table.vertex[s_.at(d)]);
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

  State& s_;
  dovetail::detail::smoother<State>& smooth_;
  double target_ = 0;
  double lacked_ = 0;             ///< by the triangles that are replaced
  std::vector<local_id> flipped_; ///< the far ends of the edges that flips gave to v
};

} // namespace dovetail::improvement
