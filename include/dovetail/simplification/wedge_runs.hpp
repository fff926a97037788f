/// @file
/// The side-dual graph under node deletion: runs of wedges between consecutive remaining sides of a ridge.
#pragma once

#include "dovetail/simplification/dual_graphs.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace dovetail {

/// Around each ridge the remaining sides cut the elements into runs of wedges; a run's angle is the sum of
/// its wedge angles. At first every wedge is a run of its own; removing a side joins the runs beside it.
///
/// Only the two end wedges of a run are addressed (they may be the same one): each knows the other end and
/// the run's angle, so a removal takes constant time and no ridge table is needed. A run around a whole ridge
/// without any side is gone.
template <side_dual_graph G>
class wedge_runs {
public:
  static constexpr wedge_id none = std::numeric_limits<wedge_id>::max();

  /// The graph must outlive the runs.
  explicit wedge_runs(const G& graph)
      : graph_(&graph), angle_(graph.angles()), other_end_(angle_.size()), removed_(graph.side_count(), 0) {
    std::iota(other_end_.begin(), other_end_.end(), wedge_id{0});
  }

  std::size_t wedge_count() const { return angle_.size(); }
  /// Is the wedge at an end of a run?
  bool is_end(wedge_id wedge) const { return other_end_[wedge] != none; }
  /// The wedge that stands for its run: the end with the smaller number.
  bool is_name(wedge_id wedge) const { return is_end(wedge) && wedge <= other_end_[wedge]; }
  /// Angle in degrees of the run with an end at `wedge`.
  double angle(wedge_id wedge) const { return angle_[wedge]; }
  bool is_removed(local_id side) const { return removed_[static_cast<std::size_t>(side)] != 0; }

  /// The two remaining sides that bound the run with an end at `wedge`; the same one twice when it is the
  /// last of its ridge.
  std::array<local_id, 2> bounding_sides(wedge_id wedge) const {
    const wedge_id other = other_end_[wedge];
    const auto [a, b] = graph_->sides(wedge);
    if (other == wedge)
      return {a, b};
    const auto [c, d] = graph_->sides(other);
    return {is_removed(a) ? b : a, is_removed(c) ? d : c};
  }

  /// Removes a side that is not fixed from all its ridges and calls `on_run(name)` for every run that grew.
  template <class OnRun>
  void remove(local_id side, const OnRun& on_run) {
    removed_[static_cast<std::size_t>(side)] = 1;
    graph_->for_each_joint(side, [&](wedge_id v, wedge_id w) { join(v, w, on_run); });
  }

private:
  template <class OnRun>
  void join(wedge_id a, wedge_id b, const OnRun& on_run) {
    const wedge_id far_a = other_end_[a];
    const wedge_id far_b = other_end_[b];
    other_end_[a] = none;
    other_end_[b] = none;
    if (far_a == b) // the last side of the ridge went
      return;
    const double total = angle_[a] + angle_[b];
    other_end_[far_a] = far_b;
    other_end_[far_b] = far_a;
    angle_[far_a] = total;
    angle_[far_b] = total;
    on_run(std::min(far_a, far_b));
  }

  const G* graph_;
  std::vector<double> angle_;         ///< per wedge at an end: the angle of its run
  std::vector<wedge_id> other_end_;   ///< per wedge: the other end of its run; `none` inside a run
  std::vector<std::uint8_t> removed_; ///< per side
};

} // namespace dovetail
