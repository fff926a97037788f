/// @file
/// Surfaces and boundary loops with known answers.
#pragma once

#include "dovetail/remesh/patch.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace dovetail::test {

inline constexpr double pi = std::numbers::pi;

struct cylinder {
  double radius = 1;
  surface_frame frame(vec2 uv) const {
    const double c = std::cos(uv.x), s = std::sin(uv.x);
    return {{radius * c, radius * s, uv.y}, {-radius * s, radius * c, 0}, {0, 0, 1}};
  }
  vec2 project(vec3, vec2 seed) const { return seed; }
};

struct sphere {
  surface_frame frame(vec2 uv) const {
    const double c = std::cos(uv.x), s = std::sin(uv.x), cv = std::cos(uv.y), sv = std::sin(uv.y);
    return {{c * cv, s * cv, sv}, {-s * cv, c * cv, 0}, {-c * sv, -s * sv, cv}};
  }
  vec2 project(vec3, vec2 seed) const { return seed; }
};

struct torus {
  double large = 1, small = 0.4;
  surface_frame frame(vec2 uv) const {
    const double c = std::cos(uv.x), s = std::sin(uv.x), cv = std::cos(uv.y), sv = std::sin(uv.y);
    const double q = large + small * cv;
    return {{c * q, s * q, small * sv}, {-s * q, c * q, 0}, {-small * c * sv, -small * s * sv, small * cv}};
  }
  vec2 project(vec3, vec2 seed) const { return seed; }
};

/// A plane in polar coordinates: u is the angle, v the radius; a pole at v = 0.
struct polar_plane {
  surface_frame frame(vec2 uv) const {
    const double c = std::cos(uv.x), s = std::sin(uv.x);
    return {{-uv.y * c, uv.y * s, 0}, {uv.y * s, uv.y * c, 0}, {-c, s, 0}};
  }
  vec2 project(vec3, vec2 seed) const { return seed; }
};

/// Appends points from p to q (q excluded), labelled first, first + step, ...
template <class S>
void add_line(patch_boundary& b, const S& s, vec2 p, vec2 q, int n, local_id first, local_id step) {
  for (int i = 0; i < n; ++i) {
    const vec2 uv = p + (static_cast<double>(i) / n) * (q - p);
    b.uv.push_back(uv);
    b.points.push_back(s.frame(uv).point);
    b.labels.push_back(first + step * i);
  }
}

/// Joins the points from index `first` on to a closed loop.
inline void close_loop(patch_boundary& b, std::size_t first = 0) {
  const auto begin = static_cast<local_id>(first), end = static_cast<local_id>(b.uv.size());
  for (local_id i = begin; i < end; ++i)
    b.segments.push_back({i, i + 1 < end ? i + 1 : begin});
}

/// The rectangle [0, width] x [low, high] as a loop whose left and right sides are a seam. Sides below and
/// above are lines (`n` segments) or, where `pole`, have one label.
template <class S>
patch_boundary seam_rectangle(const S& s, double width, double low, double high, int n, int m,
                              bool pole_below, bool pole_above) {
  patch_boundary b;
  const local_id seam = 1000000, above = 2000000;
  add_line(b, s, {0, low}, {width, low}, n, 0, pole_below ? 0 : 1);
  add_line(b, s, {width, low}, {width, high}, m, seam, 1);
  add_line(b, s, {width, high}, {0, high}, n, above, pole_above ? 0 : 1);
  add_line(b, s, {0, high}, {0, low}, m, seam + m, -1);
  b.labels[n] = 0;             // the seam starts at the first point
  b.labels[2 * n + m] = above; // and ends where the upper side does
  close_loop(b);
  return b;
}

/// How often each undirected edge of 3-space occurs, vertices named by label (inner ones by negative
/// numbers).
inline std::map<std::array<local_id, 2>, int> edge_counts(const patch_boundary& b, const patch_mesh& mesh) {
  const auto frozen = static_cast<local_id>(b.uv.size());
  const auto name = [&](local_id v) { return v < frozen ? b.labels[v] : frozen - v - 1; };
  std::map<std::array<local_id, 2>, int> counts;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const local_id a = name(t[i]), c = name(t[(i + 1) % 3]);
      ++counts[{std::min(a, c), std::max(a, c)}];
    }
  return counts;
}

} // namespace dovetail::test
