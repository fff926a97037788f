/// @file
/// In which order the operations on a surface are tried: everywhere cheap ones first, then the poor
/// triangles.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/operation_log.hpp"
#include "dovetail/improver/surface_insertion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace dovetail::improvement {

struct surface_schedule_limits {
  double target = 0.33;     ///< triangles with a smaller quality (sin^2 of the smallest angle) are worked on
  double few_poor = 0.005;  ///< with a smaller share of poor triangles nothing but those is worked on
  int relax_passes = 3;     ///< passes of the cheap smoothing over all free vertices
  int passes = 12;          ///< sweeps of flips and moves over the poor triangles
  int hard_passes = 8;      ///< sweeps in which vertices are removed and inserted as well
  double least_gain = 0.01; ///< two sweeps in a row that mend a smaller part of what is lacking are the last
  double longest_edge = 2;  ///< removing a vertex makes no edge longer than this times the target length
};

/// Works on a state of mesh/surface_operations.hpp. Flips are logged as edge removals.
template <class State>
class surface_schedule {
public:
  surface_schedule(State& state, const surface_schedule_limits& limits)
      : s_(state), limits_(limits), smooth_(state), insertion_(state, smooth_) {}

  /// Deals with the worst triangles first: when all are worked on at once, moves for the sake of the many
  /// that are nearly good stand in the way of the few that are not. A mesh with few poor triangles is not
  /// relaxed, which takes as long as making it.
  void run() {
    collect_poor();
    if (static_cast<double>(poor_.size()) > limits_.few_poor * s_.table.triangle_slots())
      relax();
    const double last = limits_.target;
    for (const double rung : {sine_squared(30), sine_squared(36)})
      if (rung < last)
        raise_to(rung);
    raise_to(last);
  }
  const operation_log& log() const { return log_; }
  int passes() const { return passes_; }

private:
  static constexpr double least_step = 0.01; ///< of quality, for operations that add or remove a vertex

  static double sine_squared(double degrees) {
    const double sine = std::sin(degrees * std::numbers::pi / 180);
    return sine * sine;
  }
  void raise_to(double target) {
    limits_.target = target;
    sweep_until_settled(limits_.passes, [this](local_id t) { mend(t); });
    sweep_until_settled(limits_.hard_passes, [this](local_id t) { mend_hard(t); });
  }

  bool is_poor(local_id t) const { return s_.table.alive(t) && s_.quality(t) < limits_.target; }

  /// The cheap part: flips and smoothing of everything.
  void relax() {
    flip_everywhere();
    for (int pass = 0; pass < limits_.relax_passes; ++pass) {
      std::size_t moved = 0;
      for (local_id v = s_.frozen; v < static_cast<local_id>(s_.point.size()); ++v)
        if (s_.table.corner_of[s_.at(v)] != no_id)
          moved += log_.record(operation::smoothing, [&] { return smooth_.relax(v); });
      if (moved == 0)
        break;
      flip_everywhere();
    }
  }
  void flip_everywhere() {
    for (local_id c = 0; c < static_cast<local_id>(s_.table.vertex.size()); ++c)
      if (s_.table.vertex[s_.at(c)] != no_id && s_.table.twin[s_.at(c)] > c)
        flip(c);
  }
  bool flip(local_id c) {
    return log_.record(operation::edge_removal, [&] {
      flips_.push(c);
      return flips_.raise_quality(s_) > 0;
    });
  }

  /// Lists the poor triangles; the result is the sum of what they lack.
  double collect_poor() {
    double deficit = 0;
    poor_.clear();
    for (local_id t = 0; t < s_.table.triangle_slots(); ++t)
      if (s_.table.alive(t))
        if (const double quality = s_.quality(t); quality < limits_.target) {
          poor_.push_back(t);
          deficit += limits_.target - quality;
        }
    return deficit;
  }
  /// Sweeps over the poor triangles until two sweeps in a row did not pay.
  template <class Mend>
  void sweep_until_settled(int passes, const Mend& mend_one) {
    failed_with_.clear();
    double deficit = collect_poor();
    for (int pass = 0, idle = 0; pass < passes && idle < 2 && !poor_.empty(); ++pass) {
      for (const local_id t : poor_)
        if (is_poor(t) && !is_settled(t)) {
          mend_one(t);
          settle(t);
        }
      ++passes_;
      const double before = std::exchange(deficit, collect_poor());
      idle = before - deficit < limits_.least_gain * before ? idle + 1 : 0;
    }
  }

  /// What the attempts at a triangle depend on, condensed: the shapes around its inner vertices.
  double surroundings(local_id t) const {
    double sum = s_.quality(t);
    for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
      const local_id v = s_.table.vertex[s_.at(c)];
      if (s_.inner(v))
        s_.table.for_each_corner(v, [&](local_id at) { sum += s_.quality(corner_table::triangle_of(at)); });
      else if (s_.table.twin[s_.at(c)] != no_id)
        sum += s_.quality(corner_table::triangle_of(s_.table.twin[s_.at(c)]));
    }
    return sum;
  }
  /// Nothing has changed around t since it was tried last.
  bool is_settled(local_id t) const {
    return s_.at(t) < failed_with_.size() && failed_with_[s_.at(t)] == surroundings(t);
  }
  void settle(local_id t) {
    if (!is_poor(t))
      return;
    failed_with_.resize(s_.at(s_.table.triangle_slots()), -1e300);
    failed_with_[s_.at(t)] = surroundings(t);
  }

  void mend(local_id t) {
    for (local_id c = 3 * t; c < 3 * t + 3 && is_poor(t); ++c)
      flip(c);
    for (local_id c = 3 * t; c < 3 * t + 3 && is_poor(t); ++c)
      if (const local_id v = s_.table.vertex[s_.at(c)]; s_.inner(v))
        log_.record(operation::smoothing, [&] { return smooth_.maximise_worst(v, limits_.target); });
  }
  /// Also removes and inserts vertices.
  void mend_hard(local_id t) {
    mend(t);
    if (is_poor(t) && !contract(t))
      insert(t);
  }
  bool contract(local_id t) {
    for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
      const local_id v = s_.table.vertex[s_.at(c)];
      if (s_.inner(v) && log_.record(operation::contraction, [&] { return remove(v); }))
        return true;
    }
    return false;
  }
  bool remove(local_id v) {
    double longest = limits_.longest_edge;
    s_.table.for_each_corner(
        v, [&](local_id c) { longest = std::max(longest, s_.relative_length(v, s_.table.tail(c))); });
    const double required = std::max(dovetail::detail::star_quality(s_, v), 0.0) + least_step;
    if (!dovetail::detail::remove_vertex(s_, v, required, longest, flips_))
      return false;
    flips_.raise_quality(s_);
    return true;
  }
  /// Splits a side of t, the longest first.
  bool insert(local_id t) {
    std::array<std::pair<double, local_id>, 3> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      const local_id c = 3 * t + static_cast<local_id>(k);
      sides[k] = {-s_.length(s_.table.tail(c), s_.table.head(c)), c};
    }
    sort_all(sides);
    for (const auto& side : sides) {
      const local_id c = side.second;
      const local_id v = s_.table.tail(c), w = s_.table.head(c);
      if (s_.table.free_side(c) && log_.record(operation::insertion, [&] {
            return insertion_.improve(c, limits_.target, least_step);
          }))
        return true;
      // An attempt that was taken back may have renamed the corners of t.
      if (!s_.table.alive(t) || s_.table.tail(c) != v || s_.table.head(c) != w)
        return false;
    }
    return false;
  }

  State& s_;
  surface_schedule_limits limits_;
  dovetail::detail::smoother<State> smooth_;
  surface_insertion<State> insertion_;
  dovetail::detail::flip_queue flips_;
  operation_log log_;
  int passes_ = 0;
  std::vector<local_id> poor_;
  std::vector<double> failed_with_; ///< per triangle: its surroundings after the last attempt
};

} // namespace dovetail::improvement
