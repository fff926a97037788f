/// @file
/// Cuts surfaces into smooth areas along feature edges, and areas into charts, clusters that can be
/// projected onto a plane without a fold.
#pragma once

#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/models/discrete/charted_surface.hpp"
#include "dovetail/models/discrete/cluster_measures.hpp"
#include "dovetail/models/discrete/contours.hpp"
#include "dovetail/models/discrete/loops.hpp"
#include "dovetail/models/discrete/oriented_surfaces.hpp"
#include "dovetail/models/discrete/smooth_areas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail {

/// How surfaces are cut into charts.
struct chart_options {
  double feature_angle_deg = 40; ///< an edge whose triangles turn by more is a feature edge
  double cone_angle_deg = 60;    ///< largest angle between a triangle's normal and its chart's mean normal
  double merge_angle_deg = 50;   ///< charts are joined again when that angle stays below this
};

namespace discrete {

/// Cuts in rounds every chart that cannot be projected yet, by the component of its normals (or, where
/// normals agree, of its positions) along their principal axis. A chart of many triangles is cut along a
/// contour line through them, so that it does not end in teeth; one of few along edges, which always ends, at
/// single triangles if need be.
class chart_cutter {
public:
  chart_cutter(const oriented_surfaces& surfaces, const chart_options& options)
      : s_{surfaces.mesh,   {}, {}, surfaces.groups, surfaces.solid_of, surfaces.front_of, {},
           surfaces.corners},
        measures_(s_.mesh), cone_(std::cos(options.cone_angle_deg * radians_per_degree)) {
    s_.front_of.resize(triangles().size(), no_id);
    connect();
    s_.smooth_of = smooth_areas(measures_, neighbours_, s_.group_of, options.feature_angle_deg);
    s_.chart_of = s_.smooth_of;
  }

  /// Cuts until every chart can be projected.
  charted_surface run() {
    for (int round = 0; round < largest_rounds; ++round) {
      gather();
      find_junctions();
      values_.assign(triangles().size(), std::nullopt);
      bool done = true;
      for (std::size_t c = 0; c < members_.size(); ++c)
        if (const auto by = needed_cut(c)) {
          if (round < rounds_of_contours && members_[c].size() >= many_triangles)
            set_corner_values(c, *by);
          else
            set_triangle_values(c, *by);
          done = false;
        }
      if (done)
        break;
      split_along_contours(s_, values_);
      connect();
      renumber_charts(round < rounds_of_contours);
    }
    gather();
    s_.frames = frames_;
    s_.mesh.tags = s_.chart_of;
    return std::move(s_);
  }

private:
  static constexpr int largest_rounds = 40;
  static constexpr int rounds_of_contours = 6;
  static constexpr std::size_t many_triangles = 100;
  static constexpr double snap =
      0.15; ///< a contour this near an edge's end, as a share of the edge, goes through it

  enum class cut_by { normal, position };

  std::vector<simplex<2>>& triangles() { return s_.mesh.elements; }
  vec3 point(local_id v) const { return measures_.point(v); }
  vec3 area_vector(std::size_t t) const { return measures_.area_vector(t); }
  bool is_sliver(std::size_t t) const { return measures_.is_sliver(t); }

  void connect() { neighbours_ = element_neighbours(build_sides<2>(s_.mesh)); }
  /// The triangle opposite corner i of t, or nowhere.
  std::size_t across(std::size_t t, std::size_t i) const {
    return static_cast<std::size_t>(neighbours_[t][i]);
  }

  void gather() {
    const local_id count = 1 + *std::max_element(s_.chart_of.begin(), s_.chart_of.end());
    members_.assign(static_cast<std::size_t>(count), {});
    for (std::size_t t = 0; t < triangles().size(); ++t)
      members_[s_.chart_of[t]].push_back(t);
    frames_.clear();
    for (const auto& chart : members_)
      frames_.push_back(measures_.frame_of(chart));
  }

  /// What the chart must be cut by; nothing when it can be projected.
  std::optional<cut_by> needed_cut(std::size_t c) const {
    if (!measures_.within_cone(members_[c], frames_[c].n, cone_))
      return members_[c].size() > 1 ? std::optional(cut_by::normal) : std::nullopt;
    const auto loops = boundary_loops(s_.mesh.elements, s_.chart_of, members_[c],
                                      [&](std::size_t t, std::size_t i) { return across(t, i); });
    if (loops_are_simple(loops, s_.mesh.points, frames_[c]))
      return std::nullopt;
    return cut_by::position;
  }

  /// The same signed value at all corners of a triangle: the cut runs along edges.
  void set_triangle_values(std::size_t c, cut_by by) {
    const auto& chart = members_[c];
    const auto vector_of = [&](std::size_t t) {
      const auto& v = triangles()[t];
      return by == cut_by::normal ? normalized(area_vector(t))
                                  : (point(v[0]) + point(v[1]) + point(v[2])) / 3;
    };
    vector_moments moments;
    for (const std::size_t t : chart)
      if (!is_sliver(t))
        moments.add(vector_of(t), norm(area_vector(t)));
    const vec3 axis = moments.principal_axis();
    double lowest = 1e300;
    double highest = -1e300;
    for (const std::size_t t : chart)
      if (!is_sliver(t)) {
        lowest = std::min(lowest, dot(vector_of(t), axis));
        highest = std::max(highest, dot(vector_of(t), axis));
      }
    for (const std::size_t t : chart) {
      const double value = dot(vector_of(t), axis) - 0.5 * (lowest + highest);
      values_[t] = corner_values{value, value, value};
    }
  }

  /// Signed values at the corners of the chart's triangles; the contour at zero is the cut.
  void set_corner_values(std::size_t c, cut_by by) {
    const auto& chart = members_[c];
    std::vector<std::pair<local_id, vec3>> at; // per vertex of the chart: normal or position
    for (const std::size_t t : chart)
      for (const local_id v : triangles()[t])
        at.emplace_back(v, by == cut_by::normal ? area_vector(t) : point(v));
    std::stable_sort(at.begin(), at.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (kept > 0 && at[kept - 1].first == at[i].first)
        at[kept - 1].second += by == cut_by::normal ? at[i].second : vec3{};
      else
        at[kept++] = at[i];
    at.resize(kept);
    const auto vector_at = [&](local_id v) {
      const auto found =
          std::lower_bound(at.begin(), at.end(), v, [](const auto& a, local_id b) { return a.first < b; });
      return by == cut_by::normal ? normalized(found->second) : found->second;
    };
    vector_moments moments;
    for (const std::size_t t : chart)
      for (const local_id v : triangles()[t])
        moments.add(vector_at(v), norm(area_vector(t)));
    const vec3 axis = moments.principal_axis();
    double lowest = 1e300;
    double highest = -1e300;
    for (const auto& [v, ignored] : at) {
      const double value = dot(vector_at(v), axis);
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    for (const std::size_t t : chart) {
      corner_values values;
      for (std::size_t i = 0; i < 3; ++i)
        values[i] = dot(vector_at(triangles()[t][i]), axis) - 0.5 * (lowest + highest);
      values_[t] = values;
    }
    snap_to_vertices(chart);
  }

  /// Vertices where three charts or more meet; the outside of a sheet counts as one.
  void find_junctions() {
    std::vector<std::pair<local_id, local_id>> around; // vertex, chart
    for (std::size_t t = 0; t < triangles().size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        around.emplace_back(triangles()[t][i], s_.chart_of[t]);
        if (across(t, i) == nowhere)
          for (const std::size_t end : {(i + 1) % 3, (i + 2) % 3})
            around.emplace_back(triangles()[t][end], no_id);
      }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    junctions_.assign(s_.mesh.points.size(), 0);
    for (std::size_t i = 2; i < around.size(); ++i)
      if (around[i].first == around[i - 2].first)
        junctions_[around[i].first] = 1;
  }
  bool is_junction(local_id v) const { return junctions_[v] != 0; }

  /// A contour that passes close to a vertex passes through it. On the chart's boundary it always does,
  /// through a junction if it can: contours from both sides would otherwise end side by side, with a tiny
  /// curve between them.
  void snap_to_vertices(const std::vector<std::size_t>& chart) {
    std::vector<local_id> snapped;
    for (const std::size_t t : chart)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const double a = (*values_[t])[i];
        const double b = (*values_[t])[j];
        if (a * b >= 0)
          continue;
        const double s = a / (a - b);
        const local_id from = triangles()[t][i];
        const local_id to = triangles()[t][j];
        const std::size_t other = across(t, (i + 2) % 3);
        const bool on_boundary = other == nowhere || s_.chart_of[other] != s_.chart_of[t];
        if (on_boundary && is_junction(from) != is_junction(to))
          snapped.push_back(is_junction(from) ? from : to);
        else if (s < (on_boundary ? 0.5 : snap))
          snapped.push_back(from);
        else if (on_boundary || s > 1 - snap)
          snapped.push_back(to);
        if (on_boundary)
          junctions_[snapped.back()] = 1;
      }
    std::sort(snapped.begin(), snapped.end());
    for (const std::size_t t : chart)
      for (std::size_t i = 0; i < 3; ++i)
        if (std::binary_search(snapped.begin(), snapped.end(), triangles()[t][i]))
          (*values_[t])[i] = 0;
  }

  /// The clusters of the charts on both sides of their contours; small ones join the other side when asked
  /// to.
  void renumber_charts(bool tidy) {
    std::vector<char> side(triangles().size(), 0);
    for (std::size_t t = 0; t < side.size(); ++t)
      if (values_[t])
        side[t] = (*values_[t])[0] + (*values_[t])[1] + (*values_[t])[2] > 0 ? 1 : 0;
    const auto joined = [&](std::size_t t, std::size_t next) {
      return s_.chart_of[t] == s_.chart_of[next] && side[t] == side[next];
    };
    if (tidy) {
      const auto cluster = clusters(neighbours_, joined);
      std::vector<double> cluster_area(
          1 + static_cast<std::size_t>(*std::max_element(cluster.begin(), cluster.end())));
      std::vector<double> chart_area(members_.size());
      for (std::size_t t = 0; t < cluster.size(); ++t) {
        cluster_area[cluster[t]] += norm(area_vector(t));
        chart_area[s_.chart_of[t]] += norm(area_vector(t));
      }
      for (std::size_t t = 0; t < cluster.size(); ++t)
        if (values_[t] && cluster_area[cluster[t]] < 0.02 * chart_area[s_.chart_of[t]])
          side[t] = side[t] ? 0 : 1;
    }
    s_.chart_of = clusters(neighbours_, joined);
  }

  charted_surface s_;
  cluster_measures measures_; ///< of s_.mesh, as it is now
  double cone_;
  std::vector<std::array<local_id, 3>> neighbours_;
  std::vector<std::vector<std::size_t>> members_; ///< per chart: its triangles
  std::vector<chart_frame> frames_;               ///< per chart
  std::vector<char> junctions_;                   ///< per vertex
  std::vector<std::optional<corner_values>> values_;
};

} // namespace discrete
} // namespace dovetail
