/// @file
/// Tidies borders between charts: thin corners go to a neighbour, and tiny borders are removed. Where
/// contours cut by different charts end side by side, a mesh would have to resolve the gap between their
/// ends.
#pragma once

#include "dovetail/core/nearest_point.hpp"
#include "dovetail/models/discrete/charts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// Collapses, edge by edge, borders within smooth areas that are short against the triangles at their ends
/// and join two junctions, where the surface stays where it is: across a ridge between two triangles, as
/// every edge of a coarse round surface is one, they do not. No feature edge is touched.
class border_collapser {
public:
  explicit border_collapser(charted_surface surface) : s_(std::move(surface)), measures_(s_.mesh) {
    find_rim();
  }

  /// Removes borders until none is short.
  charted_surface run() {
    for (int round = 0; round < largest_rounds; ++round) {
      index_vertices();
      collapsed_ = 0;
      for (local_id v = 0; v < static_cast<local_id>(at_.size()); ++v)
        if (is_junction(v))
          collapse_borders_at(v);
      drop_removed();
      if (collapsed_ == 0)
        break;
    }
    return std::move(s_);
  }

private:
  static constexpr int largest_rounds = 4;
  static constexpr double short_share = 0.6; ///< of the longest edge at the two ends
  static constexpr std::size_t most_edges = 6;
  static constexpr double least_cosine = 0.5; ///< of the angle by which a triangle turns
  static constexpr double steepest =
      0.2; ///< cosine of the angle to the chart's normal that a moved triangle keeps
  static constexpr double most_away = 0.01; ///< from the surface, of the longest edge at a moved vertex

  std::vector<simplex<2>>& triangles() { return s_.mesh.elements; }
  vec3 point(local_id v) const { return measures_.point(v); }

  void index_vertices() {
    at_.assign(s_.mesh.points.size(), {});
    removed_.assign(triangles().size(), 0);
    chart_size_.assign(s_.frames.size(), 0);
    for (const local_id c : s_.chart_of)
      ++chart_size_[c];
    for (std::size_t t = 0; t < triangles().size(); ++t)
      for (const local_id v : triangles()[t])
        at_[v].push_back(t);
  }

  /// Marks the vertices where a sheet ends or several meet; they stay where they are.
  void find_rim() {
    on_rim_.assign(s_.mesh.points.size(), 0);
    const auto sides = build_sides<2>(s_.mesh);
    for (std::size_t side = 0; side < sides.size(); ++side)
      if (!sides.is_interior(static_cast<local_id>(side)))
        for (const local_id v : sides.vertices[side])
          on_rim_[v] = 1;
  }

  static std::size_t distinct(std::vector<local_id> ids) {
    std::sort(ids.begin(), ids.end());
    return static_cast<std::size_t>(std::unique(ids.begin(), ids.end()) - ids.begin());
  }
  std::size_t count_around(local_id v, const std::vector<local_id>& tags) const {
    std::vector<local_id> ids;
    for (const std::size_t t : at_[v])
      ids.push_back(tags[t]);
    return distinct(ids);
  }
  bool on_rim(local_id v) const { return on_rim_[v] != 0; }
  bool is_junction(local_id v) const { return count_around(v, s_.chart_of) + (on_rim(v) ? 1 : 0) > 2; }
  bool on_feature(local_id v) const { return on_rim(v) || count_around(v, s_.smooth_of) > 1; }

  std::vector<std::size_t> triangles_at_edge(local_id a, local_id b) const {
    std::vector<std::size_t> found;
    for (const std::size_t t : at_[a])
      if (std::find(s_.mesh.elements[t].begin(), s_.mesh.elements[t].end(), b) != s_.mesh.elements[t].end())
        found.push_back(t);
    return found;
  }
  std::vector<local_id> neighbours(local_id v) const {
    std::vector<local_id> found;
    for (const std::size_t t : at_[v])
      for (const local_id w : s_.mesh.elements[t])
        if (w != v)
          found.push_back(w);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }
  /// Is the edge a border between two charts of one smooth area?
  bool is_inner_border(local_id a, local_id b) const {
    const auto pair = triangles_at_edge(a, b);
    return pair.size() == 2 && s_.chart_of[pair[0]] != s_.chart_of[pair[1]] &&
           s_.smooth_of[pair[0]] == s_.smooth_of[pair[1]];
  }
  double longest_edge_at(local_id v) const {
    double longest = 0;
    for (const local_id w : neighbours(v))
      longest = std::max(longest, distance(point(v), point(w)));
    return longest;
  }

  void collapse_borders_at(local_id v) {
    for (const local_id first : neighbours(v)) {
      if (!is_inner_border(v, first))
        continue;
      std::vector<local_id> path{v, first};
      while (!is_junction(path.back()) && path.size() <= most_edges) {
        const local_id next = next_on_border(path);
        if (next == no_id)
          break;
        path.push_back(next);
      }
      if (!is_junction(path.back()) || path.back() == v)
        continue;
      double length = 0;
      for (std::size_t i = 1; i < path.size(); ++i)
        length += distance(point(path[i - 1]), point(path[i]));
      if (length > short_share * std::min(longest_edge_at(v), longest_edge_at(path.back())))
        continue;
      if (on_feature(path.front()))
        std::reverse(path.begin(), path.end());
      if (on_feature(path.front()))
        continue;
      for (std::size_t i = 1; i < path.size(); ++i)
        if (!collapse(path[i - 1], path[i]))
          break;
      return; // v or its neighbours changed
    }
  }

  local_id next_on_border(const std::vector<local_id>& path) const {
    for (const local_id w : neighbours(path.back()))
      if (w != path[path.size() - 2] && is_inner_border(path.back(), w))
        return w;
    return no_id;
  }

  /// Moves vertex `gone` onto `kept`; refuses what would fold, or change the topology.
  bool collapse(local_id gone, local_id kept) {
    const auto pair = triangles_at_edge(gone, kept);
    const auto around_gone = neighbours(gone);
    const auto around_kept = neighbours(kept);
    std::vector<local_id> common;
    std::set_intersection(around_gone.begin(), around_gone.end(), around_kept.begin(), around_kept.end(),
                          std::back_inserter(common));
    if (pair.size() != 2 || common.size() != 2)
      return false;
    for (const std::size_t t : pair) // no chart may vanish
      if (chart_size_[s_.chart_of[t]] <= 2)
        return false;
    double away = std::numeric_limits<double>::infinity(); // of the place left from the triangles then
    for (const std::size_t t : at_[gone]) {
      if (t == pair[0] || t == pair[1])
        continue;
      std::array<vec3, 3> moved;
      for (std::size_t i = 0; i < 3; ++i)
        moved[i] = point(triangles()[t][i] == gone ? kept : triangles()[t][i]);
      const vec3 after = normalized(cross(moved[1] - moved[0], moved[2] - moved[0]));
      const bool turned =
          !measures_.is_sliver(t) && dot(after, normalized(measures_.area_vector(t))) < least_cosine;
      if (turned || dot(after, s_.frames[s_.chart_of[t]].n) < steepest)
        return false;
      const auto w = nearest_on_triangle(moved[0], moved[1], moved[2], point(gone));
      away = std::min(away, distance(w[0] * moved[0] + w[1] * moved[1] + w[2] * moved[2], point(gone)));
    }
    if (away > most_away * longest_edge_at(gone))
      return false;
    for (const std::size_t t : at_[gone]) {
      if (t == pair[0] || t == pair[1])
        continue;
      std::replace(triangles()[t].begin(), triangles()[t].end(), gone, kept);
      at_[kept].push_back(t);
    }
    at_[gone].clear();
    for (const std::size_t t : pair) {
      removed_[t] = 1;
      --chart_size_[s_.chart_of[t]];
      for (const local_id v : triangles()[t])
        std::erase(at_[v], t);
    }
    ++collapsed_;
    return true;
  }

  void drop_removed() {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < removed_.size(); ++t) {
      if (removed_[t])
        continue;
      triangles()[kept] = triangles()[t];
      for (auto* tags : s_.of_triangles())
        (*tags)[kept] = (*tags)[t];
      ++kept;
    }
    triangles().resize(kept);
    for (auto* tags : s_.of_triangles())
      tags->resize(kept);
    s_.mesh.tags = s_.chart_of;
  }

  charted_surface s_;
  cluster_measures measures_;
  std::vector<char> on_rim_;                 ///< per vertex
  std::vector<std::vector<std::size_t>> at_; ///< per vertex: its triangles
  std::vector<char> removed_;
  std::vector<std::size_t> chart_size_; ///< triangles left
  std::size_t collapsed_ = 0;
};

/// Can every chart be projected: one plane domain, no triangle turned over? O(n log n).
inline bool charts_can_be_projected(const charted_surface& s) {
  const cluster_measures measures(s.mesh);
  const auto neighbours = element_neighbours(build_sides<2>(s.mesh));
  std::vector<std::vector<std::size_t>> members(s.frames.size());
  for (std::size_t t = 0; t < s.chart_of.size(); ++t)
    members[s.chart_of[t]].push_back(t);
  for (std::size_t c = 0; c < members.size(); ++c) {
    if (members[c].empty() || !measures.within_cone(members[c], s.frames[c].n, 0.05))
      return false;
    const auto loops =
        boundary_loops(s.mesh.elements, s.chart_of, members[c], [&](std::size_t t, std::size_t i) {
          return static_cast<std::size_t>(neighbours[t][i]);
        });
    if (!loops_are_simple(loops, s.mesh.points, s.frames[c]))
      return false;
  }
  return true;
}

/// Gives triangles that stick out of their chart to a neighbour in the same smooth area: thin corners
/// between two borders, and teeth between two borders with one neighbour. A chart never loses its shape as
/// one plane domain by it.
class corner_relabeler {
public:
  explicit corner_relabeler(charted_surface surface)
      : s_(std::move(surface)), measures_(s_.mesh), neighbours_(element_neighbours(build_sides<2>(s_.mesh))) {
  }

  /// Moves triangles until none sticks out.
  charted_surface run() {
    members_.assign(s_.frames.size(), {});
    for (std::size_t t = 0; t < s_.chart_of.size(); ++t)
      members_[chart(t)].push_back(t);
    bool changed = true;
    for (int round = 0; changed && round < largest_rounds; ++round) {
      changed = false;
      for (std::size_t t = 0; t < s_.chart_of.size(); ++t)
        if (const local_id to = better_chart(t); to != no_id)
          changed = relabel(t, to) || changed;
    }
    s_.mesh.tags = s_.chart_of;
    for (std::size_t c = 0; c < members_.size(); ++c)
      s_.frames[c] = measures_.frame_of(members_[c]);
    return std::move(s_);
  }

private:
  static constexpr int largest_rounds = 6;
  static constexpr double thin_corner = 35 * radians_per_degree;
  static constexpr double cosine_kept = 0.3; ///< of the angle to the new chart's normal

  std::size_t across(std::size_t t, std::size_t i) const {
    return static_cast<std::size_t>(neighbours_[t][i]);
  }
  std::size_t chart(std::size_t t) const { return static_cast<std::size_t>(s_.chart_of[t]); }
  local_id chart_across(std::size_t t, std::size_t i) const {
    return across(t, i) == nowhere ? no_id : s_.chart_of[across(t, i)];
  }
  vec3 corner(std::size_t t, std::size_t i) const { return measures_.point(s_.mesh.elements[t][i % 3]); }

  /// The chart that triangle t fits better; no_id when it does not stick out of its own.
  local_id better_chart(std::size_t t) const {
    std::vector<std::size_t> borders; // local sides
    for (std::size_t i = 0; i < 3; ++i)
      if (across(t, i) == nowhere || s_.chart_of[across(t, i)] != s_.chart_of[t])
        borders.push_back(i);
    if (borders.size() != 2)
      return no_id;
    const std::size_t tip =
        3 - borders[0] - borders[1]; // both borders meet at the corner opposite the third side
    const double angle =
        angle_between(corner(t, tip + 1) - corner(t, tip), corner(t, tip + 2) - corner(t, tip));
    const bool tooth = chart_across(t, borders[0]) == chart_across(t, borders[1]);
    if (!tooth && angle > thin_corner)
      return no_id;
    const auto length = [&](std::size_t side) { return distance(corner(t, side + 1), corner(t, side + 2)); };
    if (length(borders[1]) > length(borders[0]))
      std::swap(borders[0], borders[1]);
    for (const std::size_t side : borders) {
      const std::size_t other = across(t, side);
      if (other == nowhere)
        continue;
      // Given to the chart across `side`, the triangle has its tip, if any, opposite that side.
      const double next_angle =
          angle_between(corner(t, side + 1) - corner(t, side), corner(t, side + 2) - corner(t, side));
      const bool fits = measures_.is_sliver(t) ||
                        dot(normalized(measures_.area_vector(t)), s_.frames[chart(other)].n) > cosine_kept;
      if (s_.smooth_of[other] == s_.smooth_of[t] && fits && (tooth || next_angle > angle))
        return s_.chart_of[other];
    }
    return no_id;
  }

  bool relabel(std::size_t t, local_id to) {
    const local_id from = s_.chart_of[t];
    if (members_[chart(t)].size() == 1)
      return false;
    move(t, from, to);
    if (is_plane_domain(from) && is_plane_domain(to))
      return true;
    move(t, to, from);
    return false;
  }
  void move(std::size_t t, local_id from, local_id to) {
    std::erase(members_[from], t);
    members_[to].push_back(t);
    s_.chart_of[t] = to;
  }
  bool is_plane_domain(local_id c) const {
    const auto& cluster = members_[c];
    const auto loops = boundary_loops(s_.mesh.elements, s_.chart_of, cluster,
                                      [&](std::size_t t, std::size_t i) { return across(t, i); });
    return loops_are_simple(loops, s_.mesh.points, measures_.frame_of(cluster));
  }

  charted_surface s_;
  cluster_measures measures_;
  std::vector<std::array<local_id, 3>> neighbours_;
  std::vector<std::vector<std::size_t>> members_;
};

} // namespace dovetail::discrete
