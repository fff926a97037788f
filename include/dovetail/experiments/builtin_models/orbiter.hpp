/// @file
/// The built-in orbiter: a blunt body with a double delta wing in a far-field box. Units: metres.
#pragma once

#include "dovetail/experiments/builtin_models/parts.hpp"
#include "dovetail/sizing/sources.hpp"

#include <vector>

namespace dovetail::builtin {

namespace orbiter {

inline constexpr double length = 32;  ///< of the body
inline constexpr double radius = 2.7; ///< of the body
/// Half wing: strake root, kink, tip. It lies low, near the belly.
inline constexpr wing_section strake{{9.5, 0.3, -1.2}, 19.5, 0.055};
/// Where the leading edge of the wing bends.
inline constexpr wing_section kink{{19.5, 4.4, -1.2}, 10.0, 0.08};
inline constexpr wing_section tip{{25.5, 11.5, -1.2}, 4.6, 0.09}; ///< the end of the wing
inline constexpr wing_section fin_root{{23.0, 0, 1.8}, 7.5, 0.1}; ///< the lower end of the fin
inline constexpr wing_section fin_tip{{28.7, 0, 10.0}, 3.8, 0.1}; ///< the upper end of the fin
inline constexpr vec3 pod_nose{23.5, 1.7, 1.9}; ///< the foremost point of the pod beside the fin
inline constexpr double pod_length = 9.5;       ///< of the pod
inline constexpr double pod_radius = 1.2;       ///< of the pod

/// What is at the same place on the other side of the plane y = 0.
inline wing_section mirrored(wing_section s) {
  s.leading_edge.y = -s.leading_edge.y;
  return s;
}

/// Blunt elliptic nose, then a cylinder with a flat base.
inline std::vector<vec2> body_profile() {
  constexpr double nose = 6.5;
  std::vector<vec2> profile;
  for (int i = 0; i <= 8; ++i) {
    const double a = 0.5 * std::numbers::pi * i / 8;
    profile.push_back({nose * (1 - std::cos(a)), radius * std::sin(a)});
  }
  for (const double x : {11.0, 16.0, 21.0, 26.5, length})
    profile.push_back({x, radius});
  return profile;
}

} // namespace orbiter

/// The orbiter cut out of its far-field box.
inline occt::attributed_shape orbiter_shape() {
  using namespace orbiter;
  constexpr vec3 up{0, 0, 1}, sideways{0, 1, 0};
  const auto pod = spindle_profile(pod_length, pod_radius, 0.45 * pod_length, 0.2 * pod_length);
  const std::vector<named_part> parts{
      {body_of_revolution({0, 0, 0}, body_profile()), "fuselage"},
      {lifting_surface({strake, kink, tip}, up), "wing"},
      {lifting_surface({mirrored(strake), mirrored(kink), mirrored(tip)}, up), "wing"},
      {lifting_surface({fin_root, fin_tip}, sideways), "tail"},
      {body_of_revolution(pod_nose, pod), "pods"},
      {body_of_revolution({pod_nose.x, -pod_nose.y, pod_nose.z}, pod), "pods"}};
  return difference({box({-50, -60, -60}, {100, 60, 60}), "farfield"}, parts);
}

/// Grid sources along the edges of wing and fin, at the nose and along body and pods, for `spacing` at the
/// edges, and a wide one around the whole orbiter.
inline std::vector<grid_source> orbiter_sources(double spacing) {
  using namespace orbiter;
  std::vector<grid_source> sources;
  const double h = spacing;
  const double band = 45 * h; ///< over which a source grows to the ambient size
  const auto add = [&](grid_source source, const char* name) {
    source.name = name;
    sources.push_back(source);
  };
  const auto trailing = [](const wing_section& s) { return s.leading_edge + vec3{s.chord, 0, 0}; };
  const auto panel = [&](const wing_section& from, const wing_section& to, const char* name) {
    const vec3 a = from.leading_edge, b = to.leading_edge, c = trailing(to), d = trailing(from);
    add(line_source(a, b, 2 * h, 2 * h + band, h), name);
    add(line_source(d, c, 2 * h, 2 * h + band, h), name);
    add(triangle_source(a, b, c, 3 * h, 3 * h + band, 2.5 * h), name);
    add(triangle_source(a, c, d, 3 * h, 3 * h + band, 2.5 * h), name);
  };
  const auto tip_edge = [&](const wing_section& s, const char* name) {
    add(line_source(s.leading_edge, trailing(s), 2 * h, 2 * h + band, h), name);
  };
  panel(strake, kink, "wing");
  panel(kink, tip, "wing");
  tip_edge(tip, "wing");
  panel(mirrored(strake), mirrored(kink), "wing");
  panel(mirrored(kink), mirrored(tip), "wing");
  tip_edge(mirrored(tip), "wing");
  panel(fin_root, fin_tip, "tail");
  tip_edge(fin_tip, "tail");
  for (const double side : {1.0, -1.0}) {
    const vec3 nose{pod_nose.x, side * pod_nose.y, pod_nose.z};
    add(line_source(nose, nose + vec3{pod_length, 0, 0}, 1.1 * pod_radius, 1.1 * pod_radius + band, 2 * h),
        "pods");
  }
  add(point_source({0, 0, 0}, 5 * h, 5 * h + band, 1.5 * h), "nose");
  add(line_source({3, 0, 0}, {length, 0, 0}, 1.1 * radius, 1.1 * radius + band, 3 * h), "fuselage");
  add(line_source({0, 0, 0}, {40, 0, 0}, 12, 55, 10 * h), "near field");
  return sources;
}

} // namespace dovetail::builtin
