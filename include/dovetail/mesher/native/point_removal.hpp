/// @file
/// Takes points out of a tetrahedrization that were added while its boundary was recovered.
#pragma once

#include "dovetail/mesher/native/recovery_flips.hpp"
#include "dovetail/mesher/native/star_points.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace dovetail::detail {

/// What a point weighs in the way of its own removal: its edges.
struct removal_target {
  local_id point;

  int weight(const local_changes&, local_id u, local_id v) const { return u == point || v == point ? 1 : 0; }
  int weight(const local_changes&, local_id, local_id, local_id) const { return 0; }
};

/// Removes points that nothing kept has as a vertex.
class point_removal {
public:
  point_removal(local_changes& changes, const kept_entities& kept)
      : changes_(changes), flips_(changes, kept), centers_(changes) {}

  /// Moves a point into one of its neighbours, after flips that leave it fewer of them if need be. Returns
  /// whether that was possible.
  bool remove(local_id v) {
    do {
      if (collapse(v))
        return true;
    } while (remove_edges(v));
    return false;
  }

  /// Removes what edges it can at a vertex. Returns whether there were any.
  bool remove_edges(local_id v) {
    const removal_target target{v};
    find_neighbours(v);
    std::size_t removed = 0;
    for (const local_id w : neighbours_)
      removed += flips_.remove_edge(target, v, w, -1);
    return removed > 0;
  }

private:
  bool collapse(local_id v) {
    changes_.find_star(v, star_);
    if (star_.empty())
      return true;
    changes_.find_rim(star_, rim_);
    const star_center corner = centers_.best_corner(rim_);
    if (corner.clearance == 0)
      return false;
    fresh_.clear();
    centers_.add_star(corner, rim_, fresh_);
    changes_.replace(star_, fresh_);
    return true;
  }
  void find_neighbours(local_id v) {
    changes_.find_star(v, star_);
    neighbours_.clear();
    for (const local_id e : star_)
      for (const local_id w : changes_.mesh()[e].vertices)
        if (w >= 0 && w != v)
          neighbours_.push_back(w);
    sort_unique(neighbours_);
  }

  local_changes& changes_;
  recovery_flips flips_;
  star_centers centers_;
  std::vector<local_id> star_, neighbours_;
  std::vector<simplex<2>> rim_;
  std::vector<simplex<3>> fresh_;
};

} // namespace dovetail::detail
