/// @file
/// The built-in aircraft: a loaded fighter in a far-field box, the flow domain around it. Units: metres.
#pragma once

#include "dovetail/experiments/builtin_models/parts.hpp"
#include "dovetail/sizing/sources.hpp"

#include <vector>

namespace dovetail::builtin {

namespace aircraft {

/// Where the parts are: the one place that both the shape and the grid sources are made from.
struct planform {
  wing_section root; ///< at the body
  wing_section tip;  ///< at the end

  /// The section at a share `s` of the way from the root to the tip.
  wing_section at(double s) const {
    return {(1 - s) * root.leading_edge + s * tip.leading_edge, (1 - s) * root.chord + s * tip.chord,
            (1 - s) * root.thickness + s * tip.thickness};
  }
  /// What is at the same place on the other side of the plane y = 0.
  planform mirrored() const {
    planform other = *this;
    other.root.leading_edge.y = -root.leading_edge.y;
    other.tip.leading_edge.y = -tip.leading_edge.y;
    return other;
  }
};
inline constexpr planform wing{{{6.3, 0.2, 0}, 4.9, 0.07}, {{10.3, 5.0, 0}, 1.5, 0.08}}; ///< the right wing
/// The right half of the tailplane.
inline constexpr planform tail{{{12.2, 0.15, 0}, 2.4, 0.08}, {{14.4, 2.7, 0}, 1.0, 0.09}};
inline constexpr planform fin{{{10.6, 0, 0.2}, 3.6, 0.08}, {{13.5, 0, 3.1}, 1.3, 0.09}}; ///< the fin
/// What carries a store below the wing.
inline constexpr planform pylon{{{8.7, 1.95, -0.02}, 1.9, 0.12}, {{8.9, 1.95, -0.7}, 1.7, 0.12}};

/// A store below the wing: a spindle along x.
struct store {
  vec3 nose;     ///< its foremost point
  double length; ///< along x
  double radius; ///< where it is thickest
};
inline constexpr store tank{{7.3, 1.95, -0.8}, 4.6, 0.3};     ///< carried by the pylon
inline constexpr store missile{{8.9, 3.6, -0.38}, 3.0, 0.13}; ///< free, close below the wing

/// The radius of the fuselage along x.
inline std::vector<vec2> fuselage_profile() {
  constexpr double length = 15, radius = 0.9, base = 0.5, nose = 5, taper_from = 10;
  std::vector<vec2> profile;
  for (int i = 0; i <= 8; ++i) {
    const double a = 0.5 * std::numbers::pi * i / 8;
    profile.push_back({nose * (1 - std::cos(a)), radius * std::sin(a)});
  }
  for (const double x : {6.5, 8.0, 9.5})
    profile.push_back({x, radius});
  for (int i = 0; i <= 5; ++i) {
    const double s = i / 5.0; // smooth at both ends
    const double x = taper_from + 0.4 + s * (length - taper_from - 0.4);
    profile.push_back({x, radius + (base - radius) * s * s * (3 - 2 * s)});
  }
  return profile;
}

} // namespace aircraft

/// The aircraft cut out of its far-field box.
inline occt::attributed_shape aircraft_shape() {
  using namespace aircraft;
  constexpr vec3 up{0, 0, 1}, sideways{0, 1, 0};
  const auto lofted = [](const planform& p, vec3 thickness) {
    return lifting_surface({p.root, p.tip}, thickness);
  };
  const auto spindle = [](store s) {
    return body_of_revolution(s.nose, spindle_profile(s.length, s.radius, 0.35 * s.length, 0.3 * s.length));
  };
  const auto across = [](store s) { return store{{s.nose.x, -s.nose.y, s.nose.z}, s.length, s.radius}; };

  std::vector<named_part> parts{{body_of_revolution({0, 0, 0}, fuselage_profile()), "fuselage"},
                                {lofted(wing, up), "wing"},
                                {lofted(wing.mirrored(), up), "wing"},
                                {lofted(tail, up), "tail"},
                                {lofted(tail.mirrored(), up), "tail"},
                                {lofted(fin, sideways), "tail"},
                                {lofted(pylon, sideways), "pylon"},
                                {lofted(pylon.mirrored(), sideways), "pylon"}};
  for (const store& s : {tank, across(tank), missile, across(missile)})
    parts.push_back({spindle(s), "store"});
  return difference({box({-30, -30, -30}, {45, 30, 30}), "farfield"}, parts);
}

/// Grid sources around edges of wing and tail, the nose and the stores, for `spacing` at the edges. A wide
/// source around the whole aircraft keeps the growth towards the ambient size gentle.
inline std::vector<grid_source> aircraft_sources(double spacing) {
  using namespace aircraft;
  std::vector<grid_source> sources;
  const double h = spacing;
  const double band = 45 * h; ///< over which a source grows to the ambient size
  const auto add = [&](grid_source source, const char* name) {
    source.name = name;
    sources.push_back(source);
  };
  const auto trailing = [](const wing_section& s) { return s.leading_edge + vec3{s.chord, 0, 0}; };
  const auto lifting = [&](const planform& p, const char* name) {
    const vec3 a = p.root.leading_edge, b = p.tip.leading_edge;
    const vec3 c = trailing(p.tip), d = trailing(p.root);
    add(line_source(a, b, 2 * h, 2 * h + band, h), name);
    add(line_source(d, c, 2 * h, 2 * h + band, h), name);
    add(line_source(b, c, 2 * h, 2 * h + band, h), name);
    add(triangle_source(a, b, c, 3 * h, 3 * h + band, 2.5 * h), name);
    add(triangle_source(a, c, d, 3 * h, 3 * h + band, 2.5 * h), name);
  };
  lifting(wing, "wing");
  lifting(wing.mirrored(), "wing");
  lifting(tail, "tail");
  lifting(tail.mirrored(), "tail");
  lifting(fin, "tail");
  for (const double side : {1.0, -1.0}) {
    for (const store& s : {tank, missile}) {
      const vec3 nose{s.nose.x, side * s.nose.y, s.nose.z}, end = nose + vec3{s.length, 0, 0};
      add(line_source(nose, end, 1.3 * s.radius, 1.3 * s.radius + band, 1.5 * h), "store");
    }
  }
  add(point_source({0, 0, 0}, 3 * h, 3 * h + band, 1.2 * h), "nose");
  add(line_source({1, 0, 0}, {15, 0, 0}, 1.0, 1.0 + band, 3 * h), "fuselage");
  add(line_source({0, 0, 0}, {18, 0, 0}, 5, 26, 10 * h), "near field");
  return sources;
}

} // namespace dovetail::builtin
