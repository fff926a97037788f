/// @file
/// Points on the curves of a model, shared by all faces at a curve, and their refinement.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/remesh/line_spacing.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace dovetail::background {

/// The discretised curves of a model. Surface points are numbered: CAD vertices first, then inner points
/// curve by curve.
struct curve_points {
  std::vector<std::vector<double>> t; ///< per curve: parameters from t[0] to t[1], ends included
  std::vector<local_id> first_inner;  ///< per curve: surface point of its first inner point
  local_id count = 0;                 ///< all surface points on curves and vertices

  /// The surface point of the i-th parameter of curve c.
  local_id point_id(const geometry_topology& topology, local_id c, std::size_t i) const {
    const auto& curve = topology.curves[c];
    const auto& parameters = t[c];
    if (i == 0 || curve.degenerate)
      return curve.vertices[0];
    if (i + 1 == parameters.size())
      return curve.vertices[1];
    return first_inner[c] + static_cast<local_id>(i) - 1;
  }

  /// Numbers the points, after their parameters `t` were set.
  void number(const geometry_topology& topology) {
    count = static_cast<local_id>(topology.vertices.size());
    first_inner.assign(t.size(), no_id);
    for (std::size_t c = 0; c < t.size(); ++c) {
      first_inner[c] = count;
      if (!topology.curves[c].degenerate)
        count += static_cast<local_id>(t[c].size()) - 2;
    }
  }
};

/// Halves the given intervals (curve, index of the interval's first parameter) once each.
inline void halve_intervals(curve_points& points, std::vector<std::array<local_id, 2>> intervals) {
  sort_unique(intervals);
  for (std::size_t k = intervals.size(); k-- > 0;) { // from behind: indices stay valid
    auto& t = points.t[intervals[k][0]];
    const auto i = static_cast<std::size_t>(intervals[k][1]);
    t.insert(t.begin() + static_cast<std::ptrdiff_t>(i) + 1, 0.5 * (t[i] + t[i + 1]));
  }
}

namespace detail {

/// Of several curves between the same two vertices at most one may be a single segment, or two faces would
/// meet in one mesh edge there: all but the shortest get a second segment.
inline void separate_parallel_curves(const geometry_topology& topology, const std::vector<double>& lengths,
                                     curve_points& points) {
  std::map<std::array<local_id, 2>, std::vector<local_id>> single;
  for (std::size_t c = 0; c < points.t.size(); ++c)
    if (!topology.curves[c].degenerate && points.t[c].size() == 2) {
      auto ends = topology.curves[c].vertices;
      sort_all(ends);
      single[ends].push_back(static_cast<local_id>(c));
    }
  std::vector<std::array<local_id, 2>> intervals;
  for (auto& [ends, curves] : single) {
    if (curves.size() < 2)
      continue;
    stable_sort_all(curves, [&](local_id a, local_id b) { return lengths[a] < lengths[b]; });
    for (std::size_t i = 1; i < curves.size(); ++i)
      intervals.push_back({curves[i], 0});
  }
  halve_intervals(points, std::move(intervals));
}

} // namespace detail

/// Least number of segments per curve that lets the faces at it be surfaces: three for a closed curve and for
/// a seam that ends at a pole.
inline std::vector<int> least_segments(const geometry_topology& topology) {
  std::vector<int> least(topology.curves.size(), 1);
  for (std::size_t c = 0; c < least.size(); ++c)
    if (topology.curves[c].vertices[0] == topology.curves[c].vertices[1])
      least[c] = 3;
  for (const auto& face : topology.faces) {
    const bool has_pole = std::any_of(face.coedges.begin(), face.coedges.end(), [&](const auto& coedge) {
      return topology.curves[coedge.curve].degenerate;
    });
    std::map<local_id, int> passages;
    for (const auto& coedge : face.coedges)
      if (++passages[coedge.curve] > 1 && has_pole)
        least[coedge.curve] = 3;
  }
  return least;
}

/// Spaces points on all curves; a segment turns by at most `largest_turn` (radians), unless it would get
/// shorter than `smallest_fraction` times the given size.
template <geometry_model Geometry, sizing_field Size>
curve_points space_curves(const Geometry& model, const Size& sizing, double largest_turn,
                          double smallest_fraction) {
  const geometry_topology& topology = model.topology();
  const std::vector<int> least = least_segments(topology);
  constexpr std::size_t pole_parameters =
      9; // a pole is a fan in space; this many keep its plane image convex
  curve_points points;
  points.t.resize(topology.curves.size());
  std::vector<double> lengths(topology.curves.size(), 0);
  for (std::size_t c = 0; c < topology.curves.size(); ++c) {
    const auto& curve = topology.curves[c];
    const auto id = static_cast<local_id>(c);
    if (curve.degenerate) {
      for (std::size_t i = 0; i < pole_parameters; ++i)
        points.t[c].push_back(curve.t[0] + (curve.t[1] - curve.t[0]) * static_cast<double>(i) /
                                               static_cast<double>(pole_parameters - 1));
      points.t[c].back() = curve.t[1];
      continue;
    }
    const remesh::line_spacing spacing{.minimum_segments = least[c],
                                       .largest_turn = largest_turn,
                                       .smallest_turn_size =
                                           smallest_fraction *
                                           sizing(model.curve_point(id, 0.5 * (curve.t[0] + curve.t[1])))};
    points.t[c] = spacing([&](double t) { return model.curve_frame(id, t); }, curve.t[0], curve.t[1], sizing);
    for (int i = 0; i < 8; ++i)
      lengths[c] += distance(model.curve_point(id, curve.t[0] + 0.125 * i * (curve.t[1] - curve.t[0])),
                             model.curve_point(id, curve.t[0] + 0.125 * (i + 1) * (curve.t[1] - curve.t[0])));
  }
  detail::separate_parallel_curves(topology, lengths, points);
  points.number(topology);
  return points;
}

} // namespace dovetail::background
