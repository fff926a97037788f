/// @file
/// Inserts a vertex: a cavity is grown around the place where the worst of the new elements would be, and the
/// place moved to suit it, until the cavity's old elements are beaten. Free vertices that the cavity swallows
/// are removed with it, so that with a large first cavity this also contracts edges.
///
/// In the spirit of the insertion of B. M. Klingner and J. R. Shewchuk, "Aggressive tetrahedral mesh
/// improvement", with a greedy search instead of a lexicographic one.
#pragma once

#include "dovetail/improver/tetrahedra/operation_limits.hpp"
#include "dovetail/improver/tetrahedra/star_cavity.hpp"

namespace dovetail::improvement {

/// How long a cavity is grown, and what new edges keep to.
struct insertion_limits {
  int growth = 12;                ///< elements added to the first cavity at most
  int patience = 5;               ///< growths without progress before giving up
  apex_search_limits search = {}; ///< of the place of the new vertex
  size_band band = {};            ///< edges stay within it
};

/// The operation that inserts a vertex near an element.
template <shape_measure Measure>
class vertex_insertion {
public:
  static constexpr std::array names{"insertion"}; ///< for reports
  static constexpr turn when = turn::hard;        ///< it is tried in the sweeps with hard operations

  /// Tries the middle of `e`, then that of each of its edges.
  bool mend(tet_complex& mesh, local_id e, const operation_limits<3>& limits, const recorded_tries& tries) {
    insertion_limits own{.search = limits.search(), .band = limits.band};
    if (limits.is_last_round) {
      own.growth = 30;
      own.patience = 12;
    }
    const auto& v = mesh.vertices(e);
    const vec3 center = 0.25 * (mesh.point(v[0]) + mesh.point(v[1]) + mesh.point(v[2]) + mesh.point(v[3]));
    if (tries([&] { return improve(mesh, {&e, 1}, center, own); }))
      return true;
    for (int edge = 0; edge < 6; ++edge)
      if (collect_shell(mesh, e, edge, shell_) && tries([&] {
            const vec3 middle = midpoint(mesh.point(shell_.a), mesh.point(shell_.b));
            return improve(mesh, shell_.elements.view(), middle, own);
          }))
        return true;
    return false;
  }

  /// Replaces a cavity that contains the elements `seed` by the star of a new vertex near `place`, if that
  /// beats the elements replaced. O(growth x cavity).
  bool improve(tet_complex& mesh, std::span<const local_id> seed, vec3 place,
               const insertion_limits& limits) {
    cavity_.clear();
    for (const local_id e : seed)
      if (!cavity_.elements.push(e))
        return false;
    float best_gain = least_gain, promise = -3;
    int idle = 0;
    best_.clear();
    auto rough = limits.search;
    rough.iterations = rough_iterations;
    for (int step = 0; step <= limits.growth && idle < limits.patience; ++step) {
      if (!find_outline(mesh, cavity_, no_id))
        break;
      const float bar = worst_value(mesh, cavity_.elements.view());
      const float gain = std::min(settle(mesh, cavity_, place, rough), rough.enough) - bar;
      idle = gain > promise ? 0 : idle + 1;
      promise = std::max(promise, gain);
      if (gain > best_gain && may_lose_inside(mesh, cavity_, no_id, 1)) {
        best_gain = gain;
        best_ = cavity_;
        best_place_ = place;
        best_bar_ = bar;
        if (gain + bar >= rough.enough)
          break;
      }
      if (!grow(mesh, place))
        break;
    }
    if (best_.elements.size == 0)
      return false;
    settle(mesh, best_, best_place_, limits.search);
    return commit(mesh, limits.band);
  }

private:
  static constexpr float least_gain = 1e-4F;
  static constexpr int rough_iterations = 2; ///< linearisations while the cavity grows

  /// Moves `place` to where the worst new element is best; returns its value.
  float settle(const tet_complex& mesh, const star_cavity& cavity, vec3& place,
               const apex_search_limits& limits) {
    double length = 0;
    for (const auto& side : cavity.outline)
      length = std::max(length, norm_squared(mesh.point(side[0]) - place));
    batch_.start(place, std::sqrt(length));
    for (const auto& side : cavity.outline)
      batch_.add(mesh.point(side[0]), mesh.point(side[1]), mesh.point(side[2]));
    batch_.finish();
    triple<float> p{0, 0, 0};
    const float reached = search_.climb(batch_, p, limits);
    place = batch_.to_global(p);
    return reached;
  }
  /// Takes in the element behind the worst new element that is not on a fixed side.
  bool grow(const tet_complex& mesh, vec3 place) {
    half_side worst_side = no_id;
    double worst = 3;
    for (int i = 0; i < cavity_.outline.size; ++i) {
      const half_side inner = cavity_.inner[i];
      if (mesh.is_fixed(element_of(inner), side_of(inner)))
        continue;
      const auto& side = cavity_.outline[i];
      const double value =
          measure_of<Measure>(place, mesh.point(side[0]), mesh.point(side[1]), mesh.point(side[2]));
      if (value < worst) {
        worst = value;
        worst_side = inner;
      }
    }
    return worst_side != no_id &&
           cavity_.elements.push(element_of(mesh.across(element_of(worst_side), side_of(worst_side))));
  }
  bool commit(tet_complex& mesh, const size_band& band) {
    const local_id v = mesh.add_vertex(best_place_, mean_size(mesh));
    if (fill_from<Measure>(mesh, best_, v, best_bar_, band, change_))
      return true;
    mesh.release_vertex(v);
    return false;
  }

  /// Of the vertices that the new one is joined to.
  float mean_size(const tet_complex& mesh) const {
    float sum = 0;
    for (const auto& side : best_.outline)
      for (const local_id v : side)
        sum += mesh.size_at(v);
    return sum / static_cast<float>(3 * best_.outline.size);
  }

  edge_shell shell_;
  star_cavity cavity_, best_;
  vec3 best_place_;
  float best_bar_ = 0;
  star_batch<Measure> batch_;
  apex_search<Measure> search_;
  local_change change_;
};

} // namespace dovetail::improvement
