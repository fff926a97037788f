/// @file
/// Makes the boundaries of parts manifold by reassigning whole super-elements.
#pragma once

#include "dovetail/decomposition/reassignment.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

/// Repairs defects one by one: tries to give groups of super-elements at the defect to another part there,
/// and keeps the change that removes most defects, then moves least weight. A change is made only when the
/// total number of defects shrinks, both parts stay connected and no part is emptied; so this terminates.
template <int D>
class manifold_repair {
public:
  explicit manifold_repair(reassignable_parts<D>& parts) : parts_(parts) {}

  /// Repairs what can be repaired; returns the number of super-elements that changed their part.
  std::size_t run() {
    const std::vector<local_id> defective = defective_points();
    std::set<local_id> open(defective.begin(), defective.end());
    std::size_t moved = 0;
    while (!open.empty()) {
      const local_id v = *open.begin();
      open.erase(open.begin());
      if (parts_.defects_at(v) == 0)
        continue;
      const change best = best_change(v);
      if (best.supers.empty())
        continue;
      moved += best.supers.size();
      parts_.assign(best.supers, best.to);
      for (const local_id w : parts_.points_of(best.supers)) // v itself among them, if still open
        if (parts_.defects_at(w) > 0)
          open.insert(w);
    }
    return moved;
  }

  /// Points that have defects, growing.
  std::vector<local_id> defective_points() {
    std::vector<local_id> points;
    for (std::size_t v = 0; v < parts_.point_count(); ++v)
      if (parts_.defects_at(static_cast<local_id>(v)) > 0)
        points.push_back(static_cast<local_id>(v));
    return points;
  }

private:
  struct change {
    std::vector<local_id> supers;
    local_id to = no_id;
    int removed = 0; ///< defects
    double weight = 0;

    auto key() const { return std::tuple(-removed, weight, to, supers); }
  };

  /// Groups to try: every single super-element at the point, and every cluster of those of one part that
  /// are neighbours of each other.
  std::vector<std::vector<local_id>> groups_at(local_id point) const {
    const std::vector<local_id> supers = parts_.supers_at(point);
    std::vector<std::vector<local_id>> groups;
    for (const local_id s : supers)
      groups.push_back({s});
    std::vector<bool> seen(supers.size(), false);
    for (std::size_t k = 0; k < supers.size(); ++k) {
      if (seen[k])
        continue;
      std::vector<local_id> cluster{supers[k]};
      seen[k] = true;
      for (std::size_t c = 0; c < cluster.size(); ++c)
        for (std::size_t j = 0; j < supers.size(); ++j)
          if (!seen[j] && parts_.part_of(supers[j]) == parts_.part_of(supers[k]) &&
              are_neighbours(cluster[c], supers[j])) {
            seen[j] = true;
            cluster.push_back(supers[j]);
          }
      std::sort(cluster.begin(), cluster.end());
      if (cluster.size() > 1)
        groups.push_back(std::move(cluster));
    }
    return groups;
  }
  bool are_neighbours(local_id a, local_id b) const {
    const auto row = parts_.graph().row(a);
    return std::binary_search(row.begin(), row.end(), b);
  }

  change best_change(local_id point) {
    std::vector<change> changes;
    for (const auto& group : groups_at(point)) {
      const std::vector<local_id> points = parts_.points_of(group);
      for (const local_id to : parts_.parts_beside(group))
        if (const int removed = parts_.defects_removed_by(group, to, points); removed > 0)
          changes.push_back({group, to, removed, parts_.weight_of(group)});
    }
    std::sort(changes.begin(), changes.end(),
              [](const change& a, const change& b) { return a.key() < b.key(); });
    for (change& candidate : changes)
      if (parts_.keeps_connected(candidate.supers))
        return std::move(candidate);
    return {};
  }

  reassignable_parts<D>& parts_;
};

} // namespace dovetail
