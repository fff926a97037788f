/// @file
/// The side-dual graph under node deletion: runs of dihedrals between consecutive remaining sides of a ridge.
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

/// Around each ridge the remaining sides cut the elements into runs of dihedrals; a run's angle is the sum of
/// its dihedral angles. At first every dihedral is a run of its own; removing a side joins the runs beside
/// it.
///
/// Only the two end dihedrals of a run are addressed (they may be the same one): each knows the other end and
/// the run's angle, so a removal takes constant time and no ridge table is needed. A run around a whole ridge
/// without any side is gone.
template <side_dual_graph G>
class dihedral_runs {
public:
  static constexpr dihedral_id none = std::numeric_limits<dihedral_id>::max(); ///< no dihedral

  /// The graph must outlive the runs.
  explicit dihedral_runs(const G& graph)
      : graph_(&graph), angle_(graph.angles()), other_end_(angle_.size()), removed_(graph.side_count(), 0) {
    std::iota(other_end_.begin(), other_end_.end(), dihedral_id{0});
  }

  /// How many dihedrals there are, ends of runs or not.
  std::size_t dihedral_count() const { return angle_.size(); }
  /// Is the dihedral at an end of a run?
  bool is_end(dihedral_id dihedral) const { return other_end_[dihedral] != none; }
  /// The dihedral that stands for its run: the end with the smaller number.
  bool is_name(dihedral_id dihedral) const { return is_end(dihedral) && dihedral <= other_end_[dihedral]; }
  /// Angle in degrees of the run with an end at `dihedral`.
  double angle(dihedral_id dihedral) const { return angle_[dihedral]; }
  /// Whether `side` has been removed.
  bool is_removed(local_id side) const { return removed_[side] != 0; }

  /// The two remaining sides that bound the run with an end at `dihedral`; the same one twice when it is the
  /// last of its ridge.
  std::array<local_id, 2> bounding_sides(dihedral_id dihedral) const {
    const dihedral_id other = other_end_[dihedral];
    const auto [a, b] = graph_->sides(dihedral);
    if (other == dihedral)
      return {a, b};
    const auto [c, d] = graph_->sides(other);
    return {is_removed(a) ? b : a, is_removed(c) ? d : c};
  }

  /// Removes a side that is not fixed from all its ridges and calls `on_run(name)` for every run that grew.
  template <class OnRun>
  void remove(local_id side, const OnRun& on_run) {
    removed_[side] = 1;
    graph_->for_each_joint(side, [&](dihedral_id v, dihedral_id w) { join(v, w, on_run); });
  }

private:
  template <class OnRun>
  void join(dihedral_id a, dihedral_id b, const OnRun& on_run) {
    const dihedral_id far_a = other_end_[a];
    const dihedral_id far_b = other_end_[b];
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
  std::vector<double> angle_;          ///< per dihedral at an end: the angle of its run
  std::vector<dihedral_id> other_end_; ///< per dihedral: the other end of its run; `none` inside a run
  std::vector<std::uint8_t> removed_;  ///< per side
};

} // namespace dovetail
