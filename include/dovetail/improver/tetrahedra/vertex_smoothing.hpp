/// @file
/// Moves one free vertex so that the worst element around it gets better.
#pragma once

#include "dovetail/improver/tetrahedra/operation_limits.hpp"
#include "dovetail/improver/tetrahedra/star_move.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail::improvement {

/// The operation that moves the vertices of an element.
template <shape_measure Measure>
class vertex_smoothing {
public:
  static constexpr std::array names{"smoothing"}; ///< for reports
  static constexpr turn when = turn::always;      ///< it is tried in all sweeps

  /// Moves the free vertices of `e` in turn as long as it is poor.
  bool mend(tet_complex& mesh, local_id e, const operation_limits<3>& limits, const recorded_tries& tries) {
    forget_other_limits(limits);
    const auto corners = mesh.vertices(e);
    bool helped = false;
    for (const local_id v : corners)
      if (mesh.is_free(v) && limits.is_poor(mesh, e) && !has_failed(mesh, v)) {
        if (tries([&] { return improve(mesh, v, limits.search(), limits.band); }))
          helped = true;
        else
          failed_at_[v] = mesh.now();
      }
    return helped;
  }

  /// Moves `v` when that raises the worst value of its star by more than rounding could feign and keeps the
  /// edges in the band. O(star).
  bool improve(tet_complex& mesh, local_id v, const apex_search_limits& limits, const size_band& band) {
    if (!star_.start(mesh, v))
      return false;
    const vec3 old_point = mesh.point(v);
    const float old_worst = star_.worst(mesh);
    double length = 0;
    for (const local_id e : star_.elements())
      length = std::max(length, norm_squared(mesh.point(other_vertex(mesh, e, v)) - old_point));
    batch_.start(old_point, std::sqrt(length));
    for (const local_id e : star_.elements()) {
      const auto [a, b, c] = star_.opposite_side(mesh, e);
      batch_.add(a, b, c);
    }
    batch_.finish();
    triple<float> p{0, 0, 0};
    if (!(search_.climb(batch_, p, limits) > old_worst + 1e-4F))
      return false;
    return star_.move(mesh, batch_.to_global(p), {.worst = old_worst}, band);
  }

private:
  static local_id other_vertex(const tet_complex& mesh, local_id e, local_id v) {
    return mesh.vertex(e, 0) == v ? mesh.vertex(e, 1) : mesh.vertex(e, 0);
  }

  /// Whether a vertex was tried in vain and nothing has changed around it since: it is tried for each poor
  /// element that has it.
  bool has_failed(const tet_complex& mesh, local_id v) {
    if (static_cast<std::size_t>(v) >= failed_at_.size())
      failed_at_.resize(static_cast<std::size_t>(mesh.vertex_slots()), 0);
    return failed_at_[v] >= std::max(mesh.changed_at(v), std::uint32_t{1});
  }
  void forget_other_limits(const operation_limits<3>& limits) {
    if (limits.search() != search_limits_)
      failed_at_.clear();
    search_limits_ = limits.search();
  }

  apex_search_limits search_limits_;
  std::vector<std::uint32_t> failed_at_; ///< per vertex; 0: never
  star_move<Measure> star_;
  star_batch<Measure> batch_;
  apex_search<Measure> search_;
};

} // namespace dovetail::improvement
