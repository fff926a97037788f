/// @file
/// Fills what lies between two stretches of a part that touch in an edge only.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/reassignment.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// Around a non-manifold edge a part has several runs of elements, with gaps between them that other parts
/// share. Giving one gap wholly to the part closes it; this takes super-elements of several parts.
template <int D>
class gap_filler {
public:
  explicit gap_filler(reassignable_parts<D>& parts) : parts_(parts) {}

  /// Fills the gap, of all at the edges of a point, that gives the best standing, if any is better than now
  /// (`must_mend`: and mended against it). Returns the super-elements that changed their part.
  std::vector<local_id> fill_best_at(local_id point, bool must_mend) {
    if constexpr (D == 2) {
      return {};
    } else {
      const auto start = parts_.mark();
      partition_standing best = parts_.standing();
      std::optional<gap> chosen;
      for (const gap& candidate : gaps_at(point)) {
        fill(candidate);
        const partition_standing now = parts_.standing();
        if (now.is_better_than(best) && (!must_mend || now.is_mended_against(start.standing))) {
          best = now;
          chosen = candidate;
        }
        parts_.go_back_to(start);
      }
      return chosen ? fill(*chosen) : std::vector<local_id>{};
    }
  }

private:
  struct gap {
    local_id part;                ///< that may fill it
    std::vector<local_id> supers; ///< in it, of other parts, growing
  };

  std::vector<gap> gaps_at(local_id point) const {
    std::vector<local_id> others; // the far ends of the point's edges
    for (const local_id e : parts_.elements_at(point))
      for (const local_id v : parts_.mesh().elements[e])
        if (v != point)
          others.push_back(v);
    sort_unique(others);
    std::vector<gap> gaps;
    for (const local_id other : others)
      append_gaps(gaps, point, other);
    return gaps;
  }

  local_id part_of_element(local_id e) const { return parts_.part_of(parts_.super_of(e)); }

  void append_gaps(std::vector<gap>& gaps, local_id a, local_id b) const {
    std::vector<local_id> around;
    std::vector<local_id> labels;
    for (const local_id e : parts_.elements_at(a)) {
      const auto& vertices = parts_.mesh().elements[e];
      if (std::find(vertices.begin(), vertices.end(), b) != vertices.end()) {
        around.push_back(e);
        labels.push_back(part_of_element(e));
      }
    }
    sort_unique(labels);
    for (const local_id part : labels) {
      if (runs(around, [&](local_id e) { return part_of_element(e) == part; }).size() < 2)
        continue;
      for (const auto& run : runs(around, [&](local_id e) { return part_of_element(e) != part; })) {
        gap found{part, {}};
        for (const local_id e : run)
          found.supers.push_back(parts_.super_of(e));
        sort_unique(found.supers);
        gaps.push_back(std::move(found));
      }
    }
  }

  /// The elements around an edge that satisfy a condition, in runs connected through sides.
  template <class Condition>
  std::vector<std::vector<local_id>> runs(const std::vector<local_id>& around,
                                          const Condition& wanted) const {
    std::vector<std::vector<local_id>> found;
    std::vector<bool> seen(around.size(), false);
    for (std::size_t k = 0; k < around.size(); ++k) {
      if (seen[k] || !wanted(around[k]))
        continue;
      std::vector<local_id> run{around[k]};
      seen[k] = true;
      for (std::size_t r = 0; r < run.size(); ++r)
        for (const local_id side : parts_.sides().of_element[run[r]]) {
          const auto other =
              std::find(around.begin(), around.end(), parts_.sides().across(side, run[r])) - around.begin();
          const auto j = static_cast<std::size_t>(other);
          if (j < around.size() && !seen[j] && wanted(around[j])) {
            seen[j] = true;
            run.push_back(around[j]);
          }
        }
      found.push_back(std::move(run));
    }
    return found;
  }

  /// Gives the super-elements of a gap to its part, those next to the part first, with what they cut off.
  /// Stops where one may not go; the caller judges the standing.
  std::vector<local_id> fill(const gap& g) {
    std::vector<local_id> changed;
    for (bool progress = true; progress;) {
      progress = false;
      for (const local_id s : g.supers) {
        if (parts_.part_of(s) == g.part || !is_beside(s, g.part))
          continue;
        const auto group = parts_.with_cut_off({s}, g.part);
        if (!group)
          continue;
        parts_.assign(*group, g.part);
        append(changed, *group);
        progress = true;
      }
    }
    return changed;
  }

  bool is_beside(local_id super, local_id part) const {
    const auto row = parts_.graph().row(super);
    return std::any_of(row.begin(), row.end(), [&](local_id other) { return parts_.part_of(other) == part; });
  }

  reassignable_parts<D>& parts_;
};

} // namespace dovetail
