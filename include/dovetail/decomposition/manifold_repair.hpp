/// @file
/// Makes the boundaries of parts manifold by reassigning whole super-elements.
#pragma once

#include "dovetail/decomposition/boundary_defects.hpp"
#include "dovetail/decomposition/connectivity.hpp"

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
  /// `graph` is the graph of super-elements with edges inside one material only; `part` is its partition,
  /// changed in place.
  manifold_repair(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                  std::span<const local_id> super_of_element, const csr_graph& graph,
                  std::span<local_id> part)
      : mesh_(mesh), defects_(mesh, sides), super_(super_of_element), graph_(graph), part_(part) {
    elements_of_super_.resize(static_cast<std::size_t>(graph.node_count()));
    for (std::size_t e = 0; e < super_.size(); ++e)
      elements_of_super_[static_cast<std::size_t>(super_[e])].push_back(static_cast<local_id>(e));
  }

  /// Repairs what can be repaired; returns the number of super-elements that changed their part.
  std::size_t run() {
    std::set<local_id> open;
    for (std::size_t v = 0; v < mesh_.points.size(); ++v)
      if (defects_at(static_cast<local_id>(v)) > 0)
        open.insert(static_cast<local_id>(v));
    std::size_t moved = 0;
    while (!open.empty()) {
      const local_id v = *open.begin();
      open.erase(open.begin());
      if (defects_at(v) == 0)
        continue;
      const change best = best_change(v);
      if (best.supers.empty())
        continue;
      moved += best.supers.size();
      assign(best.supers, best.to);
      for (const local_id w : points_of(best.supers)) // v itself among them, if still open
        if (defects_at(w) > 0)
          open.insert(w);
    }
    return moved;
  }

  /// Points that still have defects, growing.
  std::vector<local_id> defective_points() {
    std::vector<local_id> points;
    for (std::size_t v = 0; v < mesh_.points.size(); ++v)
      if (defects_at(static_cast<local_id>(v)) > 0)
        points.push_back(static_cast<local_id>(v));
    return points;
  }

private:
  struct change {
    std::vector<local_id> supers;
    local_id to = no_id;
    int gain = 0;
    double weight = 0;

    auto key() const { return std::tuple(-gain, weight, to, supers); }
  };

  local_id part_of(local_id element) const {
    return part_[static_cast<std::size_t>(super_[static_cast<std::size_t>(element)])];
  }
  int defects_at(local_id point) {
    return defects_.count_at(point, [this](local_id e) { return part_of(e); });
  }
  int defects_at(const std::vector<local_id>& points) {
    int total = 0;
    for (const local_id v : points)
      total += defects_at(v);
    return total;
  }
  std::vector<local_id> points_of(const std::vector<local_id>& supers) const {
    std::vector<local_id> points;
    for (const local_id s : supers)
      for (const local_id e : elements_of_super_[static_cast<std::size_t>(s)])
        for (const local_id v : mesh_.elements[static_cast<std::size_t>(e)])
          points.push_back(v);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }
  void assign(const std::vector<local_id>& supers, local_id to) {
    for (const local_id s : supers)
      part_[static_cast<std::size_t>(s)] = to;
  }

  /// The super-elements at a point, growing.
  std::vector<local_id> supers_at(local_id point) const {
    std::vector<local_id> supers;
    for (const local_id e : defects_.around().at(point))
      supers.push_back(super_[static_cast<std::size_t>(e)]);
    std::sort(supers.begin(), supers.end());
    supers.erase(std::unique(supers.begin(), supers.end()), supers.end());
    return supers;
  }

  /// Groups to try: every single super-element at the point, and every cluster of those of one part that
  /// are neighbours of each other.
  std::vector<std::vector<local_id>> groups_at(const std::vector<local_id>& supers) const {
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
          if (!seen[j] && label(supers[j]) == label(supers[k]) && are_neighbours(cluster[c], supers[j])) {
            seen[j] = true;
            cluster.push_back(supers[j]);
          }
      std::sort(cluster.begin(), cluster.end());
      if (cluster.size() > 1)
        groups.push_back(std::move(cluster));
    }
    return groups;
  }
  local_id label(local_id super) const { return part_[static_cast<std::size_t>(super)]; }
  bool are_neighbours(local_id a, local_id b) const {
    const auto row = graph_.row(a);
    return std::binary_search(row.begin(), row.end(), b);
  }

  change best_change(local_id point) {
    const std::vector<local_id> supers = supers_at(point);
    std::vector<change> changes;
    for (const auto& group : groups_at(supers)) {
      const std::vector<local_id> points = points_of(group);
      const int before = defects_at(points);
      for (const local_id to : targets_of(group)) {
        const local_id from = label(group[0]);
        assign(group, to);
        change candidate{group, to, before - defects_at(points), weight_of(group)};
        assign(group, from);
        if (candidate.gain > 0)
          changes.push_back(std::move(candidate));
      }
    }
    std::sort(changes.begin(), changes.end(),
              [](const change& a, const change& b) { return a.key() < b.key(); });
    for (change& candidate : changes)
      if (keeps_parts_connected(candidate))
        return std::move(candidate);
    return {};
  }

  /// The parts next to a group (across edges of the graph, so of the same material), growing.
  std::vector<local_id> targets_of(const std::vector<local_id>& group) const {
    std::vector<local_id> targets;
    for (const local_id s : group)
      for (const local_id other : graph_.row(s))
        if (label(other) != label(group[0]))
          targets.push_back(label(other));
    std::sort(targets.begin(), targets.end());
    targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
    return targets;
  }
  double weight_of(const std::vector<local_id>& supers) const {
    double total = 0;
    for (const local_id s : supers)
      total += graph_.node_weights[static_cast<std::size_t>(s)];
    return total;
  }
  bool keeps_parts_connected(const change& candidate) {
    const local_id from = label(candidate.supers[0]);
    assign(candidate.supers, candidate.to);
    const bool fine = std::find(part_.begin(), part_.end(), from) != part_.end() &&
                      is_connected(graph_, part_, from) && is_connected(graph_, part_, candidate.to);
    assign(candidate.supers, from);
    return fine;
  }

  const simplicial_mesh<D>& mesh_;
  boundary_defects<D> defects_;
  std::span<const local_id> super_;
  const csr_graph& graph_;
  std::span<local_id> part_;
  std::vector<std::vector<local_id>> elements_of_super_;
};

} // namespace dovetail
