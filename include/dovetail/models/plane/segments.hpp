/// @file
/// Do segments in the plane cross?
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/core/vector.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// A segment of a path.
struct drawn_segment {
  vec2 from, to;
  std::size_t path = 0;
  std::size_t index = 0; ///< within its path
};

/// Whether c, on the line through a and b, lies between them or at one.
inline bool lies_between(vec2 a, vec2 b, vec2 c) {
  return std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= c.y &&
         c.y <= std::max(a.y, b.y);
}

/// Whether two segments have more in common than a common end; exact.
inline bool segments_meet(const drawn_segment& s, const drawn_segment& t) {
  const double t0 = orient2d(s.from, s.to, t.from), t1 = orient2d(s.from, s.to, t.to);
  const double s0 = orient2d(t.from, t.to, s.from), s1 = orient2d(t.from, t.to, s.to);
  const auto is_end = [](const drawn_segment& of, vec2 p) { return p == of.from || p == of.to; };
  const auto touches = [&](const drawn_segment& of, double side, vec2 p) {
    return side == 0 && lies_between(of.from, of.to, p) && !is_end(of, p);
  };
  if (touches(s, t0, t.from) || touches(s, t1, t.to) || touches(t, s0, s.from) || touches(t, s1, s.to))
    return true;
  if (is_end(s, t.from) && is_end(s, t.to))
    return true;
  return ((t0 > 0 && t1 < 0) || (t0 < 0 && t1 > 0)) && ((s0 > 0 && s1 < 0) || (s0 < 0 && s1 > 0));
}

/// The first two segments, in a sweep over x, for which `meet(s, t)`. About n log n for segments that are
/// short beside the drawing.
template <class Meet>
std::optional<std::pair<drawn_segment, drawn_segment>> first_meeting(std::vector<drawn_segment> segments,
                                                                     const Meet& meet) {
  const auto left = [](const drawn_segment& s) { return std::min(s.from.x, s.to.x); };
  const auto right = [](const drawn_segment& s) { return std::max(s.from.x, s.to.x); };
  std::sort(segments.begin(), segments.end(), [&](const drawn_segment& a, const drawn_segment& b) {
    return std::tuple(left(a), a.path, a.index) < std::tuple(left(b), b.path, b.index);
  });
  std::vector<const drawn_segment*> active;
  for (const drawn_segment& s : segments) {
    active.erase(std::remove_if(active.begin(), active.end(),
                                [&](const drawn_segment* a) { return right(*a) < left(s); }),
                 active.end());
    for (const drawn_segment* a : active) {
      const bool apart = std::max(a->from.y, a->to.y) < std::min(s.from.y, s.to.y) ||
                         std::max(s.from.y, s.to.y) < std::min(a->from.y, a->to.y);
      if (!apart && meet(*a, s))
        return std::pair(*a, s);
    }
    active.push_back(&s);
  }
  return std::nullopt;
}

} // namespace dovetail::detail
