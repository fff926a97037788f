/// @file
/// Fills a triangulated patch with points, layer by layer from its boundary, each completing a nearly
/// equilateral triangle with an edge of the finished part.
///
/// The placement follows S. Rebay, "Efficient unstructured mesh generation by means of Delaunay triangulation
/// and Bowyer-Watson algorithm", doi 10.1006/jcph.1993.1097, with lengths measured in 3-space and Lawson
/// flips in place of cavities.
#pragma once

#include "dovetail/mesh/surface_operations.hpp"
#include "dovetail/remesh/patch_state.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::detail {

/// Parameters of `fill_from_front`.
struct front_parameters {
  double finished = 0.70; ///< a triangle is finished when its circumradius is below this times its size
  double closest = 0.60;  ///< no point is placed nearer than this times the size to another
  double growth = 0.35;   ///< largest change of size per unit of distance
};

/// One sweep of the front over a patch.
template <class S>
class front {
public:
  front(patch_state<S>& state, const front_parameters& parameters) : s_(state), parameters_(parameters) {}

  /// Returns the number of points placed.
  std::size_t run(flip_queue& flips) {
    for (local_id c = 0; c < static_cast<local_id>(s_.table.vertex.size()); ++c)
      if (s_.table.vertex[c] != no_id && !s_.table.free_side(c))
        push(c);
    for (local_id t = 0; t < s_.table.triangle_slots(); ++t)
      if (s_.table.alive(t) && finished(t))
        push_sides(t);
    std::size_t placed = 0;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      const side item = queue_[i];
      if (s_.table.vertex[item.corner] == no_id || s_.table.tail(item.corner) != item.tail ||
          s_.table.head(item.corner) != item.head)
        continue;
      if (finished(corner_table::triangle_of(item.corner)))
        continue;
      if (const local_id v = advance(item.corner, flips); v != no_id) {
        ++placed;
        push_around(v);
      }
      compact(i);
    }
    return placed;
  }

private:
  struct side {
    local_id corner, tail, head;
  };

  void push(local_id c) { queue_.push_back({c, s_.table.tail(c), s_.table.head(c)}); }
  void push_sides(local_id t) {
    for (local_id c = 3 * t; c < 3 * t + 3; ++c)
      if (const local_id d = s_.table.twin[c]; d != no_id && !finished(corner_table::triangle_of(d)))
        push(d);
  }
  /// Queues the sides that the finished triangles at v, or the boundary, turn towards unfinished ones.
  void push_around(local_id v) {
    s_.table.for_each_corner(v, [&](local_id c) {
      const local_id t = corner_table::triangle_of(c);
      if (finished(t)) {
        push_sides(t);
        return;
      }
      for (local_id e = 3 * t; e < 3 * t + 3; ++e) {
        const local_id d = s_.table.twin[e];
        if (!s_.table.free_side(e) || finished(corner_table::triangle_of(d)))
          push(e);
      }
    });
  }
  void compact(std::size_t& i) {
    if (i < 100000 || i * 2 < queue_.size())
      return;
    queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    i = static_cast<std::size_t>(-1);
  }

  bool finished(local_id t) const {
    const local_id a = s_.table.vertex[3 * t], b = s_.table.vertex[3 * t + 1], c = s_.table.vertex[3 * t + 2];
    if (s_.vanishes(a, b, c))
      return true;
    const vec3 ab = s_.point[b] - s_.point[a], ac = s_.point[c] - s_.point[a];
    const double x = norm_squared(ab), y = norm_squared(ac), z = norm_squared(ac - ab);
    const double size = (s_.size[a] + s_.size[b] + s_.size[c]) / 3;
    // circumradius^2 = x y z / (4 |ab x ac|^2)
    const double limit = parameters_.finished * size;
    return x * y * z <= 4 * limit * limit * norm_squared(cross(ab, ac));
  }

  /// Places one point in front of the side opposite c; no_id when there is no room for it.
  local_id advance(local_id c, flip_queue& flips) {
    const local_id a = s_.table.tail(c), b = s_.table.head(c), apex = s_.table.vertex[c];
    const vec3 base = s_.point[b] - s_.point[a];
    const double base_length = norm(base);
    vec3 normal = s_.normal[a] + s_.normal[b];
    const vec3 inward = normalized(cross(normal, base));
    if (!(base_length > 0) || !(norm_squared(inward) > 0))
      return no_id;
    const double height = front_height(a, b, apex, base_length, inward);
    if (!(height > 0))
      return no_id;
    const vec3 wanted = midpoint(s_.point[a], s_.point[b]) + height * inward;

    const vec3 along_u = 0.5 * (s_.du[a] + s_.du[b]);
    const vec3 along_v = 0.5 * (s_.dv[a] + s_.dv[b]);
    const vec2 step = patch_state<S>::parameter_step(along_u, along_v, height * inward);
    vec2 xy = 0.5 * (s_.xy[a] + s_.xy[b]) + step;
    local_id t = locate(xy, corner_table::triangle_of(c));
    if (t == no_id)
      return no_id;
    surface_frame f = s_.frame_at(xy);
    const vec3 miss = wanted - f.point;
    if (norm_squared(miss) > 0.01 * height * height) { // the metric changes along the step: correct once
      const vec2 corrected = xy + patch_state<S>::parameter_step(f.du, f.dv, miss);
      if (const local_id u = locate(corrected, t); u != no_id) {
        const surface_frame g = s_.frame_at(corrected);
        if (norm_squared(wanted - g.point) < norm_squared(miss)) {
          xy = corrected;
          f = g;
          t = u;
        }
      }
    }
    const double near = distance(f.point, midpoint(s_.point[a], s_.point[b]));
    const double size = graded_size(f.point, s_.target(a, b), near);
    if (!has_room(t, xy, f.point, size))
      return no_id;
    if (folds(t, f))
      return no_id;
    const local_id v = s_.add_vertex(xy, f, size);
    for (const local_id made : s_.table.split_triangle(t, v))
      flips.push(3 * made + 2);
    flips.make_delaunay(s_);
    return v;
  }

  /// True when a point inside triangle t in the parameter plane would make triangles inside out in space.
  bool folds(local_id t, const surface_frame& f) const {
    const vec3 normal = normalized(cross(f.du, f.dv));
    for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
      const local_id a = s_.table.tail(c), b = s_.table.head(c);
      if (!s_.vanishes(a, b, s_.table.vertex[c]) &&
          oriented_quality(s_.point[a], s_.point[b], f.point, s_.normal[a] + s_.normal[b] + normal) <= 0)
        return s_.quality(t) > 0;
    }
    return false;
  }

  /// Distance of the new point from the base: that of an equilateral triangle of the local size, but not
  /// beyond the circumcentre of the triangle in front, so that no other point can be near.
  double front_height(local_id a, local_id b, local_id apex, double base, vec3 inward) const {
    const double size = s_.target(a, b);
    const double edge = std::clamp(size, 0.71 * base, 1.35 * base);
    const double ideal = std::sqrt(edge * edge - 0.25 * base * base);
    const vec3 pa = s_.point[a] - s_.point[apex], pb = s_.point[b] - s_.point[apex];
    const double sine = norm(cross(pa, pb));
    if (dot(s_.point[apex] - s_.point[a], inward) <= 0)
      return ideal;
    if (!(sine > 0))
      return 0;
    const double center = 0.5 * base * dot(pa, pb) / sine; // signed height of the circumcentre
    const double radius = std::sqrt(center * center + 0.25 * base * base);
    return std::min(ideal, center + radius > 0 ? std::max(center, 0.25 * base) : 0.0);
  }

  /// The size at p, kept within the growth limit of the size where the front comes from.
  double graded_size(vec3 p, double from, double near) const {
    const double change = parameters_.growth * near;
    return std::clamp(s_.target_size(p), std::max(from - change, 0.4 * from), from + change);
  }

  /// The triangle that holds a point strictly inside, found by walking from t; no_id when the walk leaves the
  /// patch or the point lies on a side.
  local_id locate(vec2 p, local_id t) const {
    local_id came_from = no_id;
    for (int steps = 0; steps < 200; ++steps) {
      local_id leave = no_id;
      bool on_side = false;
      for (local_id i = 0; i < 3; ++i) {
        const local_id c = 3 * t + (i + steps) % 3;
        if (came_from != no_id && s_.table.twin[c] == came_from)
          continue;
        const double o = orient2d(s_.xy[s_.table.tail(c)], s_.xy[s_.table.head(c)], p);
        if (o < 0) {
          leave = c;
          break;
        }
        on_side = on_side || o == 0;
      }
      if (leave == no_id)
        return on_side ? no_id : t;
      if (!s_.table.free_side(leave))
        return no_id;
      came_from = leave;
      t = corner_table::triangle_of(s_.table.twin[leave]);
    }
    return no_id;
  }

  /// True when p, inside triangle t, keeps its distance from the corners and from frozen sides.
  bool has_room(local_id t, vec2 xy, vec3 p, double size) const {
    const double room = parameters_.closest * size;
    for (local_id c = 3 * t; c < 3 * t + 3; ++c) {
      const local_id v = s_.table.vertex[c];
      if (distance(s_.point[v], p) < parameters_.closest * std::min(size, s_.size[v]))
        return false;
      const local_id a = s_.table.tail(c), b = s_.table.head(c);
      const vec3 base = s_.point[b] - s_.point[a];
      const double length = norm(base);
      if (!s_.table.free_side(c)) {
        if (norm(cross(base, p - s_.point[a])) < 0.45 * std::min(size, length) * length)
          return false;
      } else {
        const local_id d = s_.table.vertex[s_.table.twin[c]];
        if (distance(s_.point[d], p) < std::min(room, parameters_.closest * s_.size[d]))
          return false;
      }
      if (!(orient2d(s_.xy[a], s_.xy[b], xy) > 0))
        return false;
    }
    return true;
  }

  patch_state<S>& s_;
  front_parameters parameters_;
  std::vector<side> queue_;
};

} // namespace dovetail::detail
