/// @file
/// In which order and how often the operations are tried: sweeps over the poor elements, cheap ones first.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/effort.hpp"
#include "dovetail/improver/element_mender.hpp"
#include "dovetail/improver/surface_limits.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail::improvement {

struct schedule_limits {
  int passes = 8;           ///< sweeps with flips and moves
  int hard_passes = 8;      ///< sweeps in which vertices are inserted and removed as well
  double least_gain = 0.02; ///< two sweeps in a row that mend a smaller part of what they try are the last
  effort_plan hard_effort = {}; ///< of all `hard_passes` together
  mender_limits mender = {};
};

/// Stops by counts and gains, never by time.
template <shape_measure Measure>
class schedule {
public:
  /// `surface` says which elements the fixed sides of `mesh` limit; both must outlive the schedule.
  schedule(tet_complex& mesh, const surface_limits& surface, const schedule_limits& limits)
      : mesh_(mesh), surface_(surface), limits_(limits), mender_(mesh, limits.mender) {
    mesh_.set_target(limits.mender.target);
  }

  /// Changes the limits of later runs.
  void set_limits(const schedule_limits& limits) {
    limits_ = limits;
    mender_.set_limits(limits.mender);
    mesh_.set_target(limits.mender.target);
  }
  void run() {
    sweep_until_settled(limits_.passes, false, [this](local_id e) { return mender_.mend(e); });
    effort hard(limits_.hard_effort, mesh_.element_count());
    sweep_until_settled(limits_.hard_passes, true, [&](local_id e) { return mend_hard(e, hard); });
  }
  const operation_log& log() const { return mender_.log(); }
  int passes() const { return passes_; }

private:
  /// A try pays when all elements together then lack less, by this part of what the element lacked.
  static constexpr double paying_part = 0.2;

  double deficit_of(local_id e) const { return mesh_.deficit(mesh_.value(e)); }

  /// Nothing helped element `e`, and nothing around it has changed since.
  bool is_settled(local_id e) const {
    if (static_cast<std::size_t>(e) >= failed_at_.size())
      return false;
    const std::uint32_t failed = failed_at_[static_cast<std::size_t>(e)];
    const auto& v = mesh_.vertices(e);
    return failed >= std::max({mesh_.changed_at(v[0]), mesh_.changed_at(v[1]), mesh_.changed_at(v[2]),
                               mesh_.changed_at(v[3]), std::uint32_t{1}});
  }
  void settle(local_id e) {
    if (static_cast<std::size_t>(e) >= failed_at_.size())
      failed_at_.resize(static_cast<std::size_t>(mesh_.element_slots()), 0);
    failed_at_[static_cast<std::size_t>(e)] = mesh_.now();
  }
  void collect_poor() {
    poor_.clear();
    const auto& values = mesh_.values();
    for (std::size_t e = 0; e < values.size(); ++e)
      if (values[e] < limits_.mender.target)
        poor_.push_back(static_cast<local_id>(e));
  }

  void sort_worst_first() {
    sort_all(poor_, [&](local_id a, local_id b) {
      return mesh_.value(a) != mesh_.value(b) ? mesh_.value(a) < mesh_.value(b) : a < b;
    });
  }

  /// Sweeps over the poor elements until two sweeps in a row did not pay.
  template <class Mend>
  void sweep_until_settled(int passes, bool worst_first, const Mend& mend_one) {
    failed_at_.clear();
    for (int pass = 0, idle = 0; pass < passes && idle < 2; ++pass) {
      collect_poor();
      if (worst_first)
        sort_worst_first();
      const double before = mesh_.lacking();
      double tried = 0; // what the elements lacked that were tried
      for (const local_id e : poor_) {
        if (!mender_.is_poor(e) || is_settled(e))
          continue;
        tried += deficit_of(e);
        if (!mend_one(e))
          settle(e);
      }
      if (tried == 0)
        return;
      ++passes_;
      idle = before - mesh_.lacking() < limits_.least_gain * tried ? idle + 1 : 0;
    }
  }

  prospect prospect_of(local_id e) const {
    const auto& v = mesh_.vertices(e);
    if (surface_.limits(v))
      return prospect::narrow;
    const bool is_held = std::none_of(v.begin(), v.end(), [&](local_id i) { return mesh_.is_free(i); });
    return is_held && !is_bad(mesh_.value(e)) ? prospect::narrow : prospect::open;
  }
  static bool is_bad(float value) { return value < static_cast<float>(Measure::from_angle(12)); }
  bool mend_hard(local_id e, effort& budget) {
    const prospect kind = prospect_of(e);
    if (!budget.allows(kind))
      return false;
    const double before = mesh_.lacking(), wanted = paying_part * deficit_of(e);
    const bool helped = mender_.mend_hard(e);
    budget.record(kind, before - mesh_.lacking() > wanted);
    return helped;
  }

  tet_complex& mesh_;
  const surface_limits& surface_;
  schedule_limits limits_;
  element_mender<Measure> mender_;
  int passes_ = 0;
  std::vector<local_id> poor_;
  std::vector<std::uint32_t> failed_at_; ///< per element; 0: never
};

} // namespace dovetail::improvement
