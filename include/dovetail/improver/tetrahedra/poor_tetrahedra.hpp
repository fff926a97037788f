/// @file
/// The poor tetrahedra of a mesh, and which of them are worth a try; for schedule.hpp.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/improver/shape_measure.hpp"
#include "dovetail/improver/tetrahedra/effort.hpp"
#include "dovetail/improver/tetrahedra/operation_limits.hpp"
#include "dovetail/improver/tetrahedra/surface_limits.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail::improvement {

/// Poor tetrahedra for a schedule.
template <shape_measure Measure>
class poor_tetrahedra {
public:
  static constexpr int dimension = 3; ///< of tetrahedra

  /// `surface` says which elements the fixed sides of `mesh` limit; both must outlive this.
  poor_tetrahedra(tet_complex& mesh, const surface_limits& surface) : mesh_(mesh), surface_(surface) {}

  /// For the hard sweeps of each run together.
  effort_plan hard_effort = {};

  /// Elements under `limits.target` are those meant from now on.
  void aim(const operation_limits<3>& limits) {
    target_ = limits.target;
    mesh_.set_target(limits.target);
  }
  /// Forgets what was tried in vain, and for the hard operations gives new credit.
  void start(bool is_hard) {
    failed_at_.clear();
    if (is_hard)
      effort_ = effort(hard_effort, mesh_.element_count());
  }
  double lacking() const { return mesh_.lacking(); } ///< what all elements together lack to the target

  /// The worst first in hard sweeps, whose effort is bounded.
  const std::vector<local_id>& list(bool is_hard) {
    stake_ = 0;
    poor_.clear();
    const auto& values = mesh_.values();
    for (std::size_t e = 0; e < values.size(); ++e)
      if (values[e] < target_)
        poor_.push_back(static_cast<local_id>(e));
    if (is_hard)
      sort_all(poor_, [&](local_id a, local_id b) {
        return mesh_.value(a) != mesh_.value(b) ? mesh_.value(a) < mesh_.value(b) : a < b;
      });
    return poor_;
  }
  /// Whether `e` is poor and something has changed around it since it was tried in vain.
  bool is_due(local_id e) const { return mesh_.value(e) < target_ && !is_settled(e); }
  /// Calls `mend` for a due element, with hard operations if there is credit for it.
  template <class Mend>
  void attempt(local_id e, bool is_hard, const Mend& mend) {
    stake_ += lack_of(e);
    if (!(is_hard ? attempt_within_effort(e, mend) : mend()))
      settle(e);
  }
  /// What the elements lacked that were tried.
  double stake() const { return stake_; }

private:
  /// A try pays when all elements together then lack less, by this part of what the element lacked.
  static constexpr double paying_part = 0.2;

  template <class Mend>
  bool attempt_within_effort(local_id e, const Mend& mend) {
    const prospect kind = prospect_of(e);
    if (!effort_.allows(kind))
      return false;
    const double before = mesh_.lacking(), wanted = paying_part * lack_of(e);
    const bool helped = mend();
    effort_.record(kind, before - mesh_.lacking() > wanted);
    return helped;
  }
  double lack_of(local_id e) const { return mesh_.deficit(mesh_.value(e)); }
  prospect prospect_of(local_id e) const {
    const auto& v = mesh_.vertices(e);
    if (surface_.limits(v))
      return prospect::narrow;
    const bool is_held = std::none_of(v.begin(), v.end(), [&](local_id i) { return mesh_.is_free(i); });
    return is_held && !is_bad(mesh_.value(e)) ? prospect::narrow : prospect::open;
  }
  static bool is_bad(float value) { return value < static_cast<float>(Measure::from_angle(12)); }

  /// Nothing helped element `e`, and nothing around it has changed since.
  bool is_settled(local_id e) const {
    if (static_cast<std::size_t>(e) >= failed_at_.size())
      return false;
    const std::uint32_t failed = failed_at_[e];
    const auto& v = mesh_.vertices(e);
    return failed >= std::max({mesh_.changed_at(v[0]), mesh_.changed_at(v[1]), mesh_.changed_at(v[2]),
                               mesh_.changed_at(v[3]), std::uint32_t{1}});
  }
  void settle(local_id e) {
    if (static_cast<std::size_t>(e) >= failed_at_.size())
      failed_at_.resize(static_cast<std::size_t>(mesh_.element_slots()), 0);
    failed_at_[e] = mesh_.now();
  }

  tet_complex& mesh_;
  const surface_limits& surface_;
  float target_ = -2;
  double stake_ = 0;
  effort effort_{hard_effort, 0};
  std::vector<local_id> poor_;
  std::vector<std::uint32_t> failed_at_; ///< per element; 0: never
};

} // namespace dovetail::improvement
