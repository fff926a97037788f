/// @file
/// Moves one free vertex so that the worst element around it gets better.
#pragma once

#include "dovetail/improver/tetrahedra/operation_limits.hpp"
#include "dovetail/improver/tetrahedra/star_move.hpp"

namespace dovetail::improvement {

/// The operation that moves the vertices of an element.
template <shape_measure Measure>
class vertex_smoothing {
public:
  static constexpr std::array names{"smoothing"}; ///< for reports
  static constexpr turn when = turn::always;      ///< it is tried in all sweeps

  /// Moves the free vertices of `e` in turn as long as it is poor.
  bool mend(tet_complex& mesh, local_id e, const operation_limits<3>& limits, const recorded_tries& tries) {
    const auto corners = mesh.vertices(e);
    bool helped = false;
    for (const local_id v : corners)
      if (mesh.is_free(v) && limits.is_poor(mesh, e))
        helped = tries([&] { return improve(mesh, v, limits.search(), limits.band); }) || helped;
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

  star_move<Measure> star_;
  star_batch<Measure> batch_;
  apex_search<Measure> search_;
};

} // namespace dovetail::improvement
