/// @file
/// The starting state of the patch remesher: the boundary loops triangulated in the parameter plane, and long
/// edges split until none bridges a strongly curved part of the surface.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/surface_operations.hpp"
#include "dovetail/remesh/delaunay_flips.hpp"
#include "dovetail/remesh/patch_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dovetail::detail {

/// Factors that make lengths in the parameter plane resemble those in 3-space on average.
inline vec2 parameter_scale(const std::vector<surface_frame>& frames) {
  vec2 sum{0, 0};
  for (const surface_frame& f : frames)
    sum = sum + vec2{norm(f.du), norm(f.dv)};
  const double count = static_cast<double>(std::max<std::size_t>(frames.size(), 1));
  const vec2 mean{sum.x / count, sum.y / count};
  const double largest = std::max(mean.x, mean.y);
  if (!(largest > 0) || !std::isfinite(largest))
    return {1, 1};
  return {std::max(mean.x, 1e-9 * largest), std::max(mean.y, 1e-9 * largest)};
}

/// Sets the target size of boundary vertices to the mean length of their segments: the patch has to match
/// them whatever the sizing field says.
template <class S>
void set_boundary_sizes(patch_state<S>& s, const patch_boundary& boundary) {
  std::vector<double> length_sum(boundary.points.size(), 0);
  std::vector<int> count(boundary.points.size(), 0);
  for (const auto& [a, b] : boundary.segments) {
    const double length = distance(boundary.points[a], boundary.points[b]);
    if (boundary.labels[a] == boundary.labels[b])
      continue;
    for (const local_id v : {a, b}) {
      length_sum[v] += length;
      ++count[v];
    }
  }
  for (std::size_t v = 0; v < length_sum.size(); ++v)
    s.size[v] = count[v] > 0 && length_sum[v] > 0 ? length_sum[v] / count[v] : s.target_size(s.point[v]);
}

/// Makes vertices of one label that are (nearly) at the same parameters exactly so: loops that touch in a
/// vertex, and slits, differ there by rounding. The passages of a seam are far apart and stay so.
inline void join_touching_vertices(const patch_boundary& boundary, std::vector<vec2>& scaled) {
  constexpr double near = 1e-5; // relative to the shortest segment at either vertex
  std::vector<double> reach(scaled.size(), std::numeric_limits<double>::infinity());
  for (const auto& [a, b] : boundary.segments) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const double length = norm(scaled[j] - scaled[i]);
    reach[i] = std::min(reach[i], near * length);
    reach[j] = std::min(reach[j], near * length);
  }
  std::vector<std::size_t> order(scaled.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  stable_sort_all(order,
                  [&](std::size_t a, std::size_t b) { return boundary.labels[a] < boundary.labels[b]; });
  for (std::size_t first = 0, last; first < order.size(); first = last) {
    last = first + 1;
    while (last < order.size() && boundary.labels[order[last]] == boundary.labels[order[first]])
      ++last;
    for (std::size_t k = first + 1; k < last; ++k)
      for (std::size_t m = first; m < k; ++m)
        if (norm(scaled[order[k]] - scaled[order[m]]) <= std::min(reach[order[k]], reach[order[m]])) {
          scaled[order[k]] = scaled[order[m]];
          break;
        }
  }
}

/// Fills the state from the loops; the crossings and misplaced segments of `mesh` tell why it could not.
template <class S>
bool start_patch(patch_state<S>& s, const patch_boundary& boundary, patch_mesh& mesh) {
  const std::size_t count = boundary.uv.size();
  std::vector<surface_frame> frames(count);
  for (std::size_t i = 0; i < count; ++i)
    frames[i] = s.surface.frame(boundary.uv[i]);
  s.scale = parameter_scale(frames);
  std::vector<vec2> scaled(count);
  for (std::size_t i = 0; i < count; ++i)
    scaled[i] = {boundary.uv[i].x * s.scale.x, boundary.uv[i].y * s.scale.y};

  join_touching_vertices(boundary, scaled);
  loop_triangulation loops = triangulate_loops(span_of(scaled), span_of(boundary.segments));
  mesh.crossings = loops.crossings;
  mesh.misplaced = loops.misplaced;
  if (!loops.valid())
    return false;
  for (std::size_t i = 0; i < count; ++i) {
    surface_frame& f = frames[i];
    f.du = f.du / s.scale.x;
    f.dv = f.dv / s.scale.y;
    s.misfit.push_back(distance(f.point, boundary.points[i]));
    f.point = boundary.points[i];
    s.add_vertex(scaled[i], f, 0);
    s.label[i] = boundary.labels[i];
  }
  s.frozen = static_cast<local_id>(count);
  box3 box;
  for (const vec3 p : boundary.points)
    box.include(p);
  s.extent = box.diagonal();
  for (const auto& [a, b] : boundary.segments)
    if (boundary.labels[a] == boundary.labels[b])
      s.pole[a] = s.pole[b] = 1;
  s.table = std::move(loops.table);
  set_boundary_sizes(s, boundary);
  return true;
}

/// True when the straight edge a-b is a poor stand-in for the surface curve between the same parameters: it
/// turns by more than about 70 degrees.
template <class S>
bool bridges_curvature(const patch_state<S>& s, local_id a, local_id b) {
  const double chord = s.length(a, b);
  const vec2 d = s.xy[b] - s.xy[a];
  const double at_a = norm(d.x * s.du[a] + d.y * s.dv[a]);
  const double at_b = norm(d.x * s.du[b] + d.y * s.dv[b]);
  if (std::max(at_a, at_b) < 1.05 * chord && dot(s.normal[a], s.normal[b]) > 0.9)
    return false;
  double length = 0;
  vec3 from = s.point[a];
  for (int i = 1; i <= 4; ++i) {
    const vec3 to = i == 4 ? s.point[b] : s.frame_at(s.xy[a] + (0.25 * i) * d).point;
    length += distance(from, to);
    from = to;
  }
  return chord < 0.94 * length && length > 0.3 * s.target(a, b);
}

/// The free side of a triangle whose straight edge is farthest from the surface curve between the same
/// parameters, relative to its length; no_id when all are straight.
template <class S>
local_id most_bent_side(const patch_state<S>& s, local_id t) {
  local_id most = no_id;
  double bend = 1e-6;
  for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
    if (!s.table.free_side(c))
      continue;
    const local_id a = s.table.tail(c), b = s.table.head(c);
    const vec3 on_surface = s.frame_at(0.5 * (s.xy[a] + s.xy[b])).point;
    const double off = distance(on_surface, midpoint(s.point[a], s.point[b]));
    if (off > bend) {
      bend = off;
      most = c;
    }
  }
  return most;
}

/// Splits the most bent sides of triangles that are inside out in space, until there are none or splitting
/// does not help. A parameter plane that maps straight lines to strongly curved ones (polar coordinates)
/// makes such triangles although the surface itself is flat.
template <class S>
void unfold(patch_state<S>& s, flip_queue& flips) {
  const std::size_t most_vertices = 8 * s.point.size() + 2000;
  for (int round = 0; round < 12; ++round) {
    bool any = false;
    const local_id slots = s.table.triangle_slots();
    for (local_id t = 0; t < slots; ++t) {
      if (!s.table.alive(t) || s.quality(t) > 0 || s.point.size() > most_vertices)
        continue;
      const local_id c = most_bent_side(s, t);
      if (c == no_id)
        continue;
      const local_id v = split_at_middle(s, c, flips);
      if (v == no_id)
        continue;
      s.size[v] = s.target_size(s.point[v]);
      flips.raise_quality(s);
      any = true;
    }
    if (!any)
      return;
  }
}

/// Splits edges until none bridges strong curvature; afterwards lengths and angles in 3-space mean something.
template <class S>
void resolve_curvature(patch_state<S>& s) {
  std::vector<local_id> queue;
  const std::size_t most_vertices = 20 * s.point.size() + 20000;
  for (int round = 0; round < 30; ++round) {
    bool any = false;
    for (local_id c = 0; c < static_cast<local_id>(s.table.vertex.size()); ++c) {
      if (!s.table.alive(c / 3) || !s.table.free_side(c) || s.table.twin[c] < c ||
          s.point.size() > most_vertices)
        continue;
      const local_id a = s.table.tail(c), b = s.table.head(c);
      if (!bridges_curvature(s, a, b))
        continue;
      const vec2 middle = 0.5 * (s.xy[a] + s.xy[b]);
      if (middle == s.xy[a] || middle == s.xy[b])
        continue;
      flip_queue unused;
      const local_id v = split_at_middle(s, c, unused);
      if (v == no_id)
        continue;
      s.size[v] = s.target_size(s.point[v]);
      s.table.for_each_corner(v, [&](local_id e) { queue.push_back(e); });
      flip_to_delaunay(
          s.table, [&](local_id at) { return s.xy[at]; }, queue);
      any = true;
    }
    if (!any)
      return;
  }
}

} // namespace dovetail::detail
