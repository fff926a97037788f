/// @file
/// The parts of a triangulated surface that no feature edge runs through.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/models/discrete/cluster_measures.hpp"
#include "dovetail/models/discrete/loops.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// Floods over pairs of neighbours that `joined(t, next)`; numbers the clusters in the order of their first
/// triangles. `neighbours`: the triangle across the edge opposite each corner, or no_id. Linear.
template <class Joined>
std::vector<local_id> clusters(const std::vector<std::array<local_id, 3>>& neighbours, Joined&& joined) {
  std::vector<local_id> cluster(neighbours.size(), no_id);
  std::vector<std::size_t> pending;
  local_id count = 0;
  for (std::size_t seed = 0; seed < cluster.size(); ++seed) {
    if (cluster[seed] != no_id)
      continue;
    cluster[seed] = count;
    pending.assign(1, seed);
    while (!pending.empty()) {
      const std::size_t t = pending.back();
      pending.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const auto next = static_cast<std::size_t>(neighbours[t][i]);
        if (next != nowhere && cluster[next] == no_id && joined(t, next)) {
          cluster[next] = count;
          pending.push_back(next);
        }
      }
    }
    ++count;
  }
  return cluster;
}

/// Finds `smooth_areas`.
class smooth_area_finder {
public:
  smooth_area_finder(const cluster_measures& measures, const std::vector<std::array<local_id, 3>>& neighbours,
                     const std::vector<local_id>& group_of, double feature_angle)
      : measures_(measures), neighbours_(neighbours), group_of_(group_of), feature_angle_(feature_angle) {
    lend_normals();
  }

  /// The number of the area of each triangle.
  std::vector<local_id> run() {
    const auto areas = clusters(neighbours_, [&](std::size_t t, std::size_t next) {
      return group_of_[t] == group_of_[next] && turn(t, next) <= feature_angle_;
    });
    const auto creases = inner_creases(areas);
    return creases.empty() ? areas : divided(areas, creases);
  }

private:
  static constexpr double long_share = 0.5;    ///< of a triangle's longest edge; two edges at least are long
  static constexpr double short_crease = 0.05; ///< of the diagonal

  using edge = std::pair<std::size_t, std::size_t>; ///< its two triangles, the smaller number first

  std::size_t across(std::size_t t, std::size_t i) const {
    return static_cast<std::size_t>(neighbours_[t][i]);
  }
  double edge_length(std::size_t t, std::size_t i) const {
    const auto& v = measures_.corners(t);
    return distance(measures_.point(v[(i + 1) % 3]), measures_.point(v[(i + 2) % 3]));
  }

  /// Between the triangles whose normals t and `next` have; 0 where they have the same one, or none.
  double turn(std::size_t t, std::size_t next) const {
    const std::size_t a = lender_[t], b = lender_[next];
    if (a == b || a == nowhere || b == nowhere)
      return 0;
    return angle_between(measures_.area_vector(a), measures_.area_vector(b));
  }

  /// Gives each sliver the normal of a well-shaped triangle: that of a neighbour, then of neighbours'
  /// neighbours. Long edges first: a needle between two faces does not take after the third at its tip.
  void lend_normals() {
    lender_.assign(neighbours_.size(), nowhere);
    std::vector<std::size_t> asking, refused;
    for (std::size_t t = 0; t < lender_.size(); ++t)
      if (measures_.is_sliver(t))
        asking.push_back(t);
      else
        lender_[t] = t;
    while (!asking.empty() || !refused.empty()) {
      const bool over_long_edges = !asking.empty();
      std::vector<std::size_t> now;
      std::swap(now, over_long_edges ? asking : refused);
      sort_unique(now);
      std::vector<edge> lent;
      for (const std::size_t t : now)
        if (lender_[t] != nowhere)
          continue;
        else if (const std::size_t from = best_lender(t, over_long_edges ? long_share : 0); from != nowhere)
          lent.emplace_back(t, from);
        else if (over_long_edges)
          refused.push_back(t);
      for (const auto& [t, from] : lent)
        lender_[t] = from;
      for (const auto& [t, from] : lent)
        for (std::size_t i = 0; i < 3; ++i)
          if (const std::size_t next = across(t, i); next != nowhere && lender_[next] == nowhere)
            asking.push_back(next);
    }
  }

  /// Whose normal sliver t takes: of those that its neighbours in its group have, the one that its own agrees
  /// with best, then that across its longest edge. Nowhere when none of them has any.
  std::size_t best_lender(std::size_t t, double share) const {
    const vec3 own = normalized(measures_.area_vector(t));
    const double longest = std::max({edge_length(t, 0), edge_length(t, 1), edge_length(t, 2)});
    std::size_t best = nowhere;
    std::pair<double, double> merit;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = across(t, i);
      const double length = edge_length(t, i);
      if (next == nowhere || lender_[next] == nowhere || group_of_[next] != group_of_[t] ||
          length < share * longest)
        continue;
      const std::size_t from = lender_[next];
      const std::pair of_this(dot(own, normalized(measures_.area_vector(from))), length);
      if (best == nowhere || merit < of_this || (merit == of_this && from < best)) {
        best = from;
        merit = of_this;
      }
    }
    return best;
  }

  /// A well-shaped triangle, or one that has its normal from a neighbour.
  bool is_sure(std::size_t t) const {
    const std::size_t from = lender_[t];
    return from == t ||
           (from != nowhere && (across(t, 0) == from || across(t, 1) == from || across(t, 2) == from));
  }

  /// The edges that turn by more than the angle within one area, whose two sides are joined around their
  /// ends; but those of creases far smaller than the model, which a scanned surface is full of.
  std::vector<edge> inner_creases(const std::vector<local_id>& areas) const {
    std::vector<edge> edges;
    std::vector<std::array<local_id, 2>> ends;
    for (std::size_t t = 0; t < areas.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = across(t, i);
        if (next == nowhere || next < t || areas[t] != areas[next] || group_of_[t] != group_of_[next] ||
            !is_sure(t) || !is_sure(next) || turn(t, next) <= feature_angle_)
          continue;
        edges.emplace_back(t, next);
        ends.push_back({measures_.corners(t)[(i + 1) % 3], measures_.corners(t)[(i + 2) % 3]});
      }
    if (edges.empty())
      return edges;
    disjoint_sets creases(measures_.point_count());
    for (const auto& [a, b] : ends)
      creases.unite(a, b);
    std::vector<box3> extent(measures_.point_count());
    for (const auto& both : ends)
      for (const local_id v : both)
        extent[creases.find(v)].include(measures_.point(v));
    std::size_t kept = 0;
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (extent[creases.find(ends[e][0])].diagonal() >= short_crease * measures_.diagonal())
        edges[kept++] = edges[e];
    edges.resize(kept);
    return edges;
  }

  /// The areas cut so that no crease has one of them on both sides: neighbours are joined by growing turn,
  /// unless that would join what a crease is between. So a cut follows the crease, and behind its end what
  /// turns most.
  std::vector<local_id> divided(const std::vector<local_id>& areas, const std::vector<edge>& creases) const {
    const auto id = [](std::size_t t) { return static_cast<local_id>(t); };
    std::vector<std::vector<local_id>> apart(areas.size()); // per set: triangles behind its creases
    std::vector<char> is_cut(areas.size(), 0);              // per area
    for (const auto& [a, b] : creases) {
      apart[a].push_back(id(b));
      apart[b].push_back(id(a));
      is_cut[areas[a]] = 1;
    }
    std::vector<std::pair<double, edge>> joints;
    for (std::size_t t = 0; t < areas.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (const std::size_t next = across(t, i); next != nowhere && t < next && areas[t] == areas[next] &&
                                                   group_of_[t] == group_of_[next] && is_cut[areas[t]])
          if (const double angle = turn(t, next); angle <= feature_angle_)
            joints.push_back({angle, {t, next}});
    sort_all(joints);
    disjoint_sets sets(areas.size());
    for (const auto& [angle, sides] : joints) {
      const local_id a = sets.find(id(sides.first)), b = sets.find(id(sides.second));
      auto* few = &apart[a];
      auto* many = &apart[b];
      const bool swapped = many->size() < few->size();
      if (swapped)
        std::swap(few, many);
      const local_id other = swapped ? a : b;
      if (a == b || std::any_of(few->begin(), few->end(), [&](local_id t) { return sets.find(t) == other; }))
        continue;
      sets.unite(a, b);
      many->insert(many->end(), few->begin(), few->end());
      few->clear();
      if (auto& of_both = apart[sets.find(a)]; &of_both != many)
        std::swap(of_both, *many);
    }
    return clusters(neighbours_, [&](std::size_t t, std::size_t next) {
      if (areas[t] != areas[next] || group_of_[t] != group_of_[next])
        return false;
      return is_cut[areas[t]] ? sets.find(id(t)) == sets.find(id(next)) : turn(t, next) <= feature_angle_;
    });
  }

  const cluster_measures& measures_;
  const std::vector<std::array<local_id, 3>>& neighbours_;
  const std::vector<local_id>& group_of_;
  double feature_angle_;
  std::vector<std::size_t> lender_; ///< per triangle: itself, or for a sliver a well-shaped one near it
};

/// The smooth area of each triangle: neighbours of one named group that turn by no more than the angle are in
/// one. Slivers, which have no normals, join nothing: each is taken for a part of a well-shaped triangle
/// beside it, and those are compared. No crease of some length runs into an area: where its sides are joined
/// around its ends, as a bevel of tiny facets at one place of an edge would, the area is cut along it.
/// O(n log n).
inline std::vector<local_id> smooth_areas(const cluster_measures& measures,
                                          const std::vector<std::array<local_id, 3>>& neighbours,
                                          const std::vector<local_id>& group_of, double feature_angle_deg) {
  return smooth_area_finder(measures, neighbours, group_of, feature_angle_deg * radians_per_degree).run();
}

} // namespace dovetail::discrete
