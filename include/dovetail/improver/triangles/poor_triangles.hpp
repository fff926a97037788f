/// @file
/// The poor triangles of a surface, and which of them are worth a try; for schedule.hpp.
#pragma once

#include "dovetail/improver/triangles/operation_limits.hpp"

#include <vector>

namespace dovetail::improvement {

/// Poor triangles for a schedule.
class poor_triangles {
public:
  static constexpr int dimension = 2; ///< of triangles

  explicit poor_triangles(surface_complex& mesh) : mesh_(mesh) {}

  /// Triangles under `limits.target` are those meant from now on.
  void aim(const operation_limits<2>& limits) { limits_ = limits; }
  void start(bool) { failed_with_.clear(); } ///< forgets what was tried in vain

  /// Lists the poor ones as well. O(triangles).
  double lacking() {
    listed_ = stake_ = 0;
    poor_.clear();
    for (local_id t = 0; t < mesh_.table.triangle_slots(); ++t)
      if (mesh_.table.alive(t))
        if (const double quality = mesh_.quality(t); quality < limits_.target) {
          poor_.push_back(t);
          listed_ += limits_.target - quality;
        }
    return listed_;
  }
  /// The poor triangles, in the order they are to be tried.
  const std::vector<local_id>& list(bool = false) const { return poor_; }
  /// Whether `t` is poor and something has changed around it since it was tried in vain.
  bool is_due(local_id t) const { return limits_.is_poor(mesh_, t) && !is_settled(t); }
  /// Calls `mend` for a due triangle.
  template <class Mend>
  void attempt(local_id t, bool, const Mend& mend) {
    mend();
    if (limits_.is_poor(mesh_, t))
      settle(t);
    stake_ = listed_;
  }
  /// What all triangles lacked.
  double stake() const { return stake_; }

private:
  /// What the attempts at a triangle depend on, condensed: the shapes around its inner vertices.
  double surroundings(local_id t) const {
    const corner_table& table = mesh_.table;
    double sum = mesh_.quality(t);
    for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
      const local_id v = table.vertex[c];
      if (mesh_.inner(v))
        table.for_each_corner(v, [&](local_id at) { sum += mesh_.quality(corner_table::triangle_of(at)); });
      else if (table.twin[c] != no_id)
        sum += mesh_.quality(corner_table::triangle_of(table.twin[c]));
    }
    return sum;
  }
  /// Nothing has changed around t since it was tried last.
  bool is_settled(local_id t) const {
    return static_cast<std::size_t>(t) < failed_with_.size() && failed_with_[t] == surroundings(t);
  }
  void settle(local_id t) {
    failed_with_.resize(mesh_.table.triangle_slots(), -1e300);
    failed_with_[t] = surroundings(t);
  }

  surface_complex& mesh_;
  operation_limits<2> limits_;
  std::vector<local_id> poor_;
  double listed_ = 0, stake_ = 0;
  std::vector<double> failed_with_; ///< per triangle: its surroundings after the last attempt
};

} // namespace dovetail::improvement
