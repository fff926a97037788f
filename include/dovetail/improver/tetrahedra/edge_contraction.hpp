/// @file
/// Contracts an edge: the star of a free vertex is filled from one of its neighbours.
#pragma once

#include "dovetail/improver/tetrahedra/operation_limits.hpp"
#include "dovetail/improver/tetrahedra/star_cavity.hpp"

namespace dovetail::improvement {

/// The operation that contracts an edge of an element.
template <shape_measure Measure>
class edge_contraction {
public:
  static constexpr std::array names{"contraction"}; ///< for reports
  static constexpr turn when = turn::hard;          ///< it is tried in the sweeps with hard operations

  /// Tries to move each free vertex of `e` onto each of the others.
  bool mend(tet_complex& mesh, local_id e, const operation_limits<3>& limits, const recorded_tries& tries) {
    const auto corners = mesh.vertices(e);
    for (const local_id from : corners)
      for (const local_id to : corners)
        if (from != to && mesh.is_free(from) && tries([&] { return improve(mesh, from, to, limits.band); }))
          return true;
    return false;
  }

  /// Removes the free vertex `from` by moving it onto `to`, if that beats the elements around `from`.
  /// O(star).
  bool improve(tet_complex& mesh, local_id from, local_id to, const size_band& band) {
    if (!collect_star(mesh, from, star_))
      return false;
    cavity_.clear();
    for (const local_id e : star_)
      cavity_.elements.push(e);
    return find_outline(mesh, cavity_, to) && may_lose_inside(mesh, cavity_, to, 0) &&
           fill_from<Measure>(mesh, cavity_, to, worst_value(mesh, star_.view()), band, change_);
  }

private:
  bounded_list<local_id, max_star> star_;
  star_cavity cavity_;
  local_change change_;
};

} // namespace dovetail::improvement
