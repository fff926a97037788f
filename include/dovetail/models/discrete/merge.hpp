/// @file
/// Joins charts again where cuts through a whole smooth area made more of them than needed.
#pragma once

#include "dovetail/models/discrete/charts.hpp"
#include "dovetail/models/discrete/tidy.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {
namespace discrete {

/// Greedy, in rounds: neighbours in one smooth area that share the largest part of a boundary first, as long
/// as the union can still be projected. Ties by chart number.
class chart_merger {
public:
  chart_merger(charted_surface surface, double merge_angle_deg)
      : s_(std::move(surface)), measures_(s_.mesh), cosine_(std::cos(merge_angle_deg * radians_per_degree)),
        neighbours_(element_neighbours(build_sides<2>(s_.mesh))) {}

  /// Joins charts while any two may be joined.
  charted_surface run() {
    for (int round = 0; round < largest_rounds && merge_once(); ++round) {
    }
    return std::move(s_);
  }

private:
  static constexpr int largest_rounds = 30;

  struct border {
    std::size_t a;
    std::size_t b;
    double length;
  };

  std::size_t across(std::size_t t, std::size_t i) const {
    return static_cast<std::size_t>(neighbours_[t][i]);
  }
  std::size_t chart(std::size_t t) const { return static_cast<std::size_t>(s_.chart_of[t]); }

  /// Shared lengths of neighbours that no feature edge separates, those with the largest share of a perimeter
  /// first.
  std::vector<border> borders() const {
    std::vector<border> all;
    std::vector<double> perimeter(s_.frames.size(), 0);
    for (std::size_t t = 0; t < s_.chart_of.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t other = across(t, i);
        if (other != nowhere && chart(t) == chart(other))
          continue;
        const auto& v = s_.mesh.elements[t];
        const double length = distance(measures_.point(v[(i + 1) % 3]), measures_.point(v[(i + 2) % 3]));
        perimeter[chart(t)] += length;
        if (other != nowhere && chart(t) < chart(other) && s_.smooth_of[t] == s_.smooth_of[other])
          all.push_back({chart(t), chart(other), length});
      }
    std::stable_sort(all.begin(), all.end(), [](const border& x, const border& y) {
      return std::tie(x.a, x.b) < std::tie(y.a, y.b);
    });
    std::vector<border> joined;
    for (const border& one : all)
      if (!joined.empty() && joined.back().a == one.a && joined.back().b == one.b)
        joined.back().length += one.length;
      else
        joined.push_back(one);
    for (border& one : joined)
      one.length /= std::min(perimeter[one.a], perimeter[one.b]);
    std::stable_sort(joined.begin(), joined.end(),
                     [](const border& x, const border& y) { return x.length > y.length; });
    return joined;
  }

  bool can_be_one(const std::vector<std::size_t>& cluster, local_id a, local_id b) {
    const chart_frame frame = measures_.frame_of(cluster);
    if (!measures_.within_cone(cluster, frame.n, cosine_))
      return false;
    for (const std::size_t t : cluster) // as if merged, and back
      s_.chart_of[t] = a;
    const auto loops = boundary_loops(s_.mesh.elements, s_.chart_of, cluster,
                                      [&](std::size_t t, std::size_t i) { return across(t, i); });
    const bool simple = loops_are_simple(loops, s_.mesh.points, frame);
    const std::size_t of_a = members_[a].size();
    for (std::size_t k = of_a; k < cluster.size(); ++k)
      s_.chart_of[cluster[k]] = b;
    return simple;
  }

  /// One round, in which a chart is merged once at most; false when nothing was.
  bool merge_once() {
    members_.assign(s_.frames.size(), {});
    for (std::size_t t = 0; t < s_.chart_of.size(); ++t)
      members_[chart(t)].push_back(t);
    std::vector<char> merged(s_.frames.size(), 0);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const border& one : borders()) {
      if (merged[one.a] || merged[one.b])
        continue;
      std::vector<std::size_t> cluster = members_[one.a];
      cluster.insert(cluster.end(), members_[one.b].begin(), members_[one.b].end());
      if (!can_be_one(cluster, static_cast<local_id>(one.a), static_cast<local_id>(one.b)))
        continue;
      merged[one.a] = merged[one.b] = 1;
      pairs.emplace_back(one.a, one.b);
    }
    for (const auto& [a, b] : pairs)
      for (const std::size_t t : members_[b])
        s_.chart_of[t] = static_cast<local_id>(a);
    renumber();
    return !pairs.empty();
  }

  void renumber() {
    std::vector<local_id> number(s_.frames.size(), no_id);
    std::vector<std::vector<std::size_t>> members;
    for (std::size_t t = 0; t < s_.chart_of.size(); ++t) {
      local_id& id = number[chart(t)];
      if (id == no_id) {
        id = static_cast<local_id>(members.size());
        members.emplace_back();
      }
      s_.chart_of[t] = id;
      members[id].push_back(t);
    }
    s_.frames.clear();
    for (const auto& cluster : members)
      s_.frames.push_back(measures_.frame_of(cluster));
    s_.mesh.tags = s_.chart_of;
  }

  charted_surface s_;
  cluster_measures measures_;
  double cosine_;
  std::vector<std::array<local_id, 3>> neighbours_;
  std::vector<std::vector<std::size_t>> members_;
};

} // namespace discrete

/// Feature edges by angle and by named groups, and charts. About O(n log n) per round of cuts and of merges.
inline charted_surface charted(const oriented_surfaces& surfaces, const chart_options& options = {}) {
  auto cut = discrete::chart_cutter(surfaces, options).run();
  auto merged = discrete::chart_merger(std::move(cut), options.merge_angle_deg).run();
  auto relabeled = discrete::corner_relabeler(merged).run();
  if (!discrete::charts_can_be_projected(relabeled))
    relabeled = std::move(merged);
  auto collapsed = discrete::border_collapser(relabeled).run();
  return discrete::charts_can_be_projected(collapsed) ? collapsed : relabeled;
}

} // namespace dovetail
