/// @file
/// How often the operations are tried: sweeps over the poor elements, first with the cheap ones only.
#pragma once

#include "dovetail/improver/operation.hpp"

#include <utility>

namespace dovetail::improvement {

/// How often sweeps are made.
template <int D>
struct schedule_limits {
  int passes = 8;           ///< sweeps with what is tried always
  int hard_passes = 8;      ///< sweeps with the hard operations as well
  double least_gain = 0.02; ///< two sweeps in a row that mend a smaller part of what they try are the last
  operation_limits<D> operations = {}; ///< what the operations keep to
};

/// Stops by counts and gains, never by time. What differs between dimensions is in `Poor`, the poor elements
/// and what is worth a try (poor_tetrahedra.hpp, poor_triangles.hpp); for `Poor& poor`:
///
/// - `Poor::dimension`
/// - `poor.aim(limits)`: elements that are poor by `limits` are those meant from now on
/// - `poor.start(is_hard)`: before sweeps; whatever was settled may be tried again
/// - `poor.lacking()`: what all elements together lack to the target
/// - `poor.list(is_hard)`: the poor ones, in the order they are to be tried; called after `lacking`
/// - `poor.is_due(e)`: e is poor, and something has changed around it since it was tried in vain
/// - `poor.attempt(e, is_hard, mend)`: calls `mend()` for a due element if it may
/// - `poor.stake()`: what was lacking that could be gained since `list`; 0 when nothing was tried
template <class Poor, class Operations>
class schedule {
public:
  static constexpr int dimension = Poor::dimension; ///< of the elements

  /// `mesh` and `poor` must outlive the schedule.
  schedule(complex_of<dimension>& mesh, Poor& poor) : poor_(poor), operations_(mesh) {}

  /// Sweeps until nothing more comes of it, first without the hard operations and then with them.
  void run(const schedule_limits<dimension>& limits) {
    poor_.aim(limits.operations);
    sweep_until_settled(limits, false);
    sweep_until_settled(limits, true);
  }
  operation_log& log() { return operations_.log(); } ///< what was tried and what came of it
  int passes() const { return passes_; }             ///< sweeps made so far

private:
  /// Until two sweeps in a row did not pay.
  void sweep_until_settled(const schedule_limits<dimension>& limits, bool is_hard) {
    poor_.start(is_hard);
    double lacking = poor_.lacking();
    const int passes = is_hard ? limits.hard_passes : limits.passes;
    for (int pass = 0, idle = 0; pass < passes && idle < 2; ++pass) {
      for (const local_id e : poor_.list(is_hard))
        if (poor_.is_due(e))
          poor_.attempt(e, is_hard, [&] { return operations_.mend(e, limits.operations, is_hard); });
      if (poor_.stake() == 0)
        return;
      ++passes_;
      const double stake = poor_.stake(), before = std::exchange(lacking, poor_.lacking());
      idle = before - lacking < limits.least_gain * stake ? idle + 1 : 0;
    }
  }

  Poor& poor_;
  Operations operations_;
  int passes_ = 0;
};

} // namespace dovetail::improvement
