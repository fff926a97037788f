/// @file
/// Makes the boundaries of parts manifold by reassigning whole super-elements.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/gap_filling.hpp"
#include "dovetail/decomposition/reassignment.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

/// Repairs defects one by one: tries to give groups of super-elements at the defect to another part there,
/// and keeps the change that removes most defects at edges, then pays best for those at points (refused sides
/// are dear). A change is made only when both parts stay connected and no part is emptied; every change
/// lowers the number of defects at edges or, at the same number, the cost. Where nothing else helps an edge,
/// its gaps are filled (gap_filling.hpp); this may serve the weights instead, but once at each point only, so
/// this terminates.
template <int D>
class manifold_repair {
public:
  explicit manifold_repair(reassignable_parts<D>& parts, progress on_progress = {})
      : parts_(parts), gaps_(parts), on_progress_(std::move(on_progress)) {}

  /// Repairs what can be repaired.
  void run() { repair(defective_points()); }

  /// Repairs what can be repaired at some points, and what comes up beside them meanwhile. Once `most`
  /// super-elements were reassigned for it the rest stays as it is.
  void repair(const std::vector<local_id>& points,
              std::size_t most = std::numeric_limits<std::size_t>::max()) {
    const std::size_t before = parts_.assignments();
    std::set<local_id> open(points.begin(), points.end());
    std::set<local_id> filled;
    while (!open.empty()) {
      on_progress_.stop_if_requested();
      const local_id v = *open.begin();
      open.erase(open.begin());
      if (!parts_.defects_at(v).any())
        continue;
      if (parts_.assignments() - before >= most)
        return;
      const change best = best_change(v);
      std::vector<local_id> changed = best.supers;
      if (!changed.empty())
        parts_.assign(changed, best.to);
      else if (parts_.defects_at(v).edges > 0)
        changed = gaps_.fill_best_at(v, !filled.insert(v).second);
      for (const local_id w : parts_.points_of(changed)) // v itself among them, if still open
        if (parts_.defects_at(w).any())
          open.insert(w);
    }
  }

  /// Points that have defects, growing.
  std::vector<local_id> defective_points() {
    std::vector<local_id> points;
    for (std::size_t v = 0; v < parts_.point_count(); ++v)
      if (parts_.defects_at(static_cast<local_id>(v)).any())
        points.push_back(static_cast<local_id>(v));
    return points;
  }

  /// All defects that there are.
  defect_count total_defects() {
    defect_count total;
    for (std::size_t v = 0; v < parts_.point_count(); ++v)
      total += parts_.defects_at(static_cast<local_id>(v));
    return total;
  }

private:
  struct change {
    std::vector<local_id> supers;
    local_id to = no_id;
    int edges = 0;   ///< by how much the number of defects at edges grows
    double cost = 0; ///< by how much the penalty of defects at points and the cut grow together
    double weight = 0;

    auto key() const { return std::tuple(edges, cost, weight, to, supers); }
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
      sort_all(cluster);
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
    for (const auto& group : groups_at(point))
      for (const local_id to : parts_.parts_beside(group))
        add_if_gain(changes, group, to);
    sort_all(changes, [](const change& a, const change& b) { return a.key() < b.key(); });
    std::vector<change> enlarged; // by what they cut off
    for (change& candidate : changes) {
      if (parts_.keeps_connected(candidate.supers))
        return std::move(candidate);
      std::vector<local_id> all = parts_.components_cut_off_by(candidate.supers);
      if (!parts_.is_light(parts_.weight_of(all), candidate.to))
        continue;
      append(all, candidate.supers);
      sort_all(all);
      add_if_gain(enlarged, all, candidate.to);
    }
    sort_all(enlarged, [](const change& a, const change& b) { return a.key() < b.key(); });
    for (change& candidate : enlarged)
      if (parts_.keeps_connected(candidate.supers))
        return std::move(candidate);
    return {};
  }

  void add_if_gain(std::vector<change>& changes, const std::vector<local_id>& group, local_id to) {
    const double cut = parts_.cut_added_by(group, to);
    const auto cost = [&](const defect_count& removed) {
      return cut - partition_standing::penalty_of_point * removed.points;
    };
    const auto is_gain = [&](const defect_count& removed) {
      return removed.edges > 0 || (removed.edges == 0 && removed.points > 0 && cost(removed) < 0);
    };
    const defect_count removed = parts_.defects_removed_by(group, to, is_gain);
    if (is_gain(removed))
      changes.push_back({group, to, -removed.edges, cost(removed), parts_.weight_of(group)});
  }

  reassignable_parts<D>& parts_;
  gap_filler<D> gaps_;
  progress on_progress_;
};

} // namespace dovetail
