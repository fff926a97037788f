/// @file
/// From discretised curves to the patch of one CAD face.
#pragma once

#include "dovetail/background/surface_curves.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/remesh/patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace dovetail::background {

/// The boundary loops of a face, and where each segment comes from.
struct face_patch {
  patch_boundary boundary;                     ///< labels are surface points
  std::vector<std::array<local_id, 2>> origin; ///< per segment: curve, index of its interval
};

namespace detail {

/// Appends the points of one coedge but its last, which starts the next coedge.
template <geometry_model Geometry>
void append_coedge(const Geometry& model, local_id f, int k, const geometry_topology::coedge& coedge,
                   const curve_points& curves, face_patch& made) {
  const geometry_topology& topology = model.topology();
  const auto& t = curves.t[coedge.curve];
  const std::size_t count = t.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = coedge.reversed ? count - i : i;
    const local_id id = curves.point_id(topology, coedge.curve, j);
    made.boundary.uv.push_back(model.curve_uv(f, k, t[j]));
    made.boundary.labels.push_back(id);
    made.boundary.points.push_back(static_cast<std::size_t>(id) < topology.vertices.size()
                                       ? topology.vertices[id].point
                                       : model.curve_point(coedge.curve, t[j]));
    made.origin.push_back({coedge.curve, static_cast<local_id>(coedge.reversed ? j - 1 : j)});
  }
}

/// True for a pole that is (nearly) a point in the parameter plane too: it adds nothing to the loop.
template <geometry_model Geometry>
bool is_point_in_plane(const Geometry& model, local_id f, int k, const geometry_topology::curve& curve,
                       vec2 extent) {
  const vec2 d = model.curve_uv(f, k, curve.t[1]) - model.curve_uv(f, k, curve.t[0]);
  return curve.degenerate && std::abs(d.x) <= 1e-6 * extent.x && std::abs(d.y) <= 1e-6 * extent.y;
}

/// Width and height of a face in its parameter plane, from a few points of its curves.
template <geometry_model Geometry>
vec2 parameter_extent(const Geometry& model, local_id f) {
  const geometry_topology& topology = model.topology();
  vec2 lower{1e300, 1e300}, upper{-1e300, -1e300};
  int k = 0;
  for (const auto& coedge : topology.faces[f].coedges) {
    const auto& t = topology.curves[coedge.curve].t;
    for (int i = 0; i <= 4; ++i) {
      const vec2 uv = model.curve_uv(f, k, t[0] + 0.25 * i * (t[1] - t[0]));
      lower = {std::min(lower.x, uv.x), std::min(lower.y, uv.y)};
      upper = {std::max(upper.x, uv.x), std::max(upper.y, uv.y)};
    }
    ++k;
  }
  return upper - lower;
}

/// Puts the points of a pole, of which the last one begins the next coedge, on one straight line of the
/// parameter plane, as they are but for rounding: in the sliver beside it a mesher would find room for
/// points, all at the pole. The line is on the side of `inside`, since beyond a cone's tip its normal turns.
inline void straighten_pole(std::span<vec2> pole, vec2& last, vec2 inside, vec2 extent) {
  constexpr double rounding = 1e-9; // of the face's extent
  for (double vec2::*coordinate : {&vec2::x, &vec2::y}) {
    double lowest = last.*coordinate, highest = lowest;
    for (const vec2 uv : pole) {
      lowest = std::min(lowest, uv.*coordinate);
      highest = std::max(highest, uv.*coordinate);
    }
    if (highest - lowest > rounding * extent.*coordinate)
      continue;
    last.*coordinate = inside.*coordinate < lowest ? lowest : highest;
    for (vec2& uv : pole)
      uv.*coordinate = last.*coordinate;
  }
}

} // namespace detail

/// Assembles the loops of a face from its curves' points.
template <geometry_model Geometry>
face_patch make_face_patch(const Geometry& model, local_id f, const curve_points& curves) {
  const geometry_topology& topology = model.topology();
  const vec2 extent = detail::parameter_extent(model, f);
  face_patch made;
  patch_boundary& b = made.boundary;
  int k = 0;
  for (const auto& loop : topology.faces[f].loops) {
    const auto first = static_cast<local_id>(b.uv.size());
    std::vector<std::array<local_id, 2>> poles; // their points but the last
    for (const auto& coedge : loop) {
      const auto& curve = topology.curves[coedge.curve];
      const auto begin = static_cast<local_id>(b.uv.size());
      if (!detail::is_point_in_plane(model, f, k, curve, extent))
        detail::append_coedge(model, f, k, coedge, curves, made);
      if (const auto next = static_cast<local_id>(b.uv.size()); curve.degenerate && next > begin)
        poles.push_back({begin, next});
      ++k;
    }
    const auto end = static_cast<local_id>(b.uv.size());
    const vec2 inside = (1.0 / (end - first)) * std::accumulate(b.uv.begin() + first, b.uv.end(), vec2{});
    for (const auto& [begin, next] : poles)
      detail::straighten_pole(span_of(b.uv).subspan(begin, next - begin), b.uv[next < end ? next : first],
                              inside, extent);
    for (local_id i = first; i < end; ++i)
      b.segments.push_back({i, i + 1 < end ? i + 1 : first});
  }
  return made;
}

} // namespace dovetail::background
