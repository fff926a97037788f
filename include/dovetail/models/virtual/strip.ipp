/// @file
/// What `strip.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/models/virtual/strip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dovetail::virtual_topology {

namespace detail {

inline constexpr double turned_back_deg = 120; ///< a boundary that turns by more goes back along itself
inline constexpr int samples_of_side = 17;     ///< per curve

using coedges = std::vector<virtual_coedge>;

inline bool turns_back(const editable_topology& topology, const virtual_coedge& before,
                       const virtual_coedge& after) {
  return angle_between(topology.direction(before, 1), topology.direction(after, 0)) >
         turned_back_deg / degrees_per_radian;
}

/// As the loop runs.
inline side along(const coedges& given, std::size_t first, std::size_t count) {
  side made;
  for (std::size_t i = 0; i < count; ++i) {
    const virtual_coedge& coedge = given[(first + i) % given.size()];
    made.push_back({coedge.curve, !coedge.reversed});
  }
  return made;
}

inline side turned_round(side given) {
  std::reverse(given.begin(), given.end());
  for (side_curve& one : given)
    one.forward = !one.forward;
  return given;
}

/// Whether the sides are curves, each of which the face passes once: no seam, and no pole but at an end.
inline bool are_plain(const editable_topology& topology, local_id f, const std::array<side, 2>& sides) {
  for (const side& one : sides)
    for (const side_curve& passed : one) {
      int count = 0;
      for (const auto& loop : topology.loops(f))
        for (const virtual_coedge& coedge : loop)
          count += coedge.curve == passed.curve ? 1 : 0;
      if (topology.curve(passed.curve).degenerate || count != 1)
        return false;
    }
  return true;
}

/// Where a loop turns back.
inline std::vector<turn_back> turns_of_loop(const editable_topology& topology, const limits& allowed,
                                            const coedges& given, std::size_t number) {
  std::vector<std::size_t> ways; // the long ones
  for (std::size_t k = 0; k < given.size(); ++k)
    if (!is_short(topology, allowed, given[k].curve))
      ways.push_back(k);
  std::vector<turn_back> turns;
  for (std::size_t i = 0; ways.size() > 1 && i < ways.size(); ++i) {
    const std::size_t next = ways[(i + 1) % ways.size()];
    if (turns_back(topology, given[ways[i]], given[next]))
      turns.push_back({number, ways[i], next});
  }
  return turns;
}

/// The curves between the two sides at an end, from the one that arrives there to the one that leaves.
inline std::vector<local_id> curves_at(const coedges& given, const turn_back& turn) {
  std::vector<local_id> found;
  for (std::size_t k = (turn.before + 1) % given.size(); k != turn.after; k = (k + 1) % given.size())
    found.push_back(given[k].curve);
  return found;
}

/// From one coedge to another one.
inline side from_to(const coedges& given, std::size_t first, std::size_t last) {
  return along(given, first, (last + given.size() - first) % given.size() + 1);
}

/// Of one loop: where it turns back twice it has two sides.
inline std::optional<strip> strip_of_loop(const editable_topology& topology, const limits& allowed,
                                          const coedges& given) {
  const auto turns = turns_of_loop(topology, allowed, given, 0);
  if (turns.size() != 2)
    return std::nullopt;
  strip made;
  made.sides = {from_to(given, turns[0].after, turns[1].before),
                turned_round(from_to(given, turns[1].after, turns[0].before))};
  made.ends = {curves_at(given, turns[0]), curves_at(given, turns[1])};
  std::reverse(made.ends[0].begin(), made.ends[0].end()); // the loop comes from the second side there
  return made;
}

/// Of two loops, neither of which turns back.
inline std::optional<strip> ring_of_loops(const editable_topology& topology, const coedges& outer,
                                          const coedges& inner) {
  for (const coedges* one : {&outer, &inner})
    for (std::size_t k = 0; k < one->size(); ++k)
      if (one->size() > 1 && turns_back(topology, (*one)[k], (*one)[(k + 1) % one->size()]))
        return std::nullopt;
  strip made;
  made.is_ring = true;
  made.sides = {along(outer, 0, outer.size()), turned_round(along(inner, 0, inner.size()))};
  return made;
}

inline double parameter_at(const geometry_topology::curve& curve, int i, int count) {
  return curve.t[0] + (curve.t[1] - curve.t[0]) * i / (count - 1);
}

/// How far along a side the other one is well within the least limit up to there: the first place where it is
/// not, to some digits; nothing where it is so all the way.
inline std::optional<place_on_side> first_apart(const editable_topology& topology, const limits& allowed,
                                                const side& one, const side& other) {
  double least_limit = std::numeric_limits<double>::infinity();
  const auto is_near = [&](std::size_t k, double t) {
    const vec3 p = topology.point(one[k].curve, t);
    const double limit = std::min(least_limit, allowed.length(p));
    return nearest_on(topology, other, p).distance <= 0.9 * limit;
  };
  for (std::size_t k = 0; k < one.size(); ++k) {
    const auto& curve = topology.curve(one[k].curve);
    double before = one[k].forward ? curve.t[0] : curve.t[1];
    for (int i = 1; i < samples_of_side; ++i) {
      least_limit = std::min(least_limit, allowed.length(topology.point(one[k].curve, before)));
      const double t = parameter_at(curve, one[k].forward ? i : samples_of_side - 1 - i, samples_of_side);
      if (is_near(k, t)) {
        before = t;
        continue;
      }
      double apart = t;
      for (int halvings = 0; halvings < 12; ++halvings) {
        const double middle = 0.5 * (before + apart);
        (is_near(k, middle) ? before : apart) = middle;
      }
      return place_on_side{k, before, 0};
    }
  }
  return std::nullopt;
}

/// Where to cut the first side of a tip: at the given place, or before it, if what is left of a side behind
/// the cut would be a short edge. Found by bisection, to a few digits.
inline place_on_side leaving_no_short_rest(const editable_topology& topology, const limits& allowed,
                                           const strip& tip, const place_on_side& apart) {
  const auto end_of = [&](std::size_t k) {
    return topology.vertex(vertices_of(topology, tip.sides[k]).back()).point;
  };
  const auto leaves_short_rest = [&](double t) {
    const vec3 cut = topology.point(tip.sides[0][0].curve, t);
    const place_on_side beside = nearest_on(topology, tip.sides[1], cut);
    const double limit = allowed.length(cut);
    return distance(cut, end_of(0)) <= limit ||
           distance(topology.point(tip.sides[1][0].curve, beside.t), end_of(1)) <= limit;
  };
  const side_curve first = tip.sides[0][0];
  double without = topology.curve(first.curve).t[first.forward ? 0 : 1];
  double with = apart.t;
  if (!leaves_short_rest(with))
    return apart;
  for (int halvings = 0; halvings < 12; ++halvings) {
    const double middle = 0.5 * (without + with);
    (leaves_short_rest(middle) ? with : without) = middle;
  }
  return {apart.curve, without, apart.distance};
}

/// Ends both sides of a tip, a curve each, where the first one is no longer near the second one, or ends.
/// False, and nothing changed, where they are near for a short way only, or the second one ends before.
inline bool cut_where_apart(editable_topology& topology, const limits& allowed, strip& tip) {
  auto apart = first_apart(topology, allowed, tip.sides[0], tip.sides[1]);
  if (apart)
    apart = leaving_no_short_rest(topology, allowed, tip, *apart);
  const side_curve first = tip.sides[0][0];
  const place_on_side on_first =
      apart.value_or(place_on_side{0, topology.curve(first.curve).t[first.forward], 0});
  const vec3 cut = topology.point(first.curve, on_first.t);
  const place_on_side on_second = nearest_on(topology, tip.sides[1], cut);
  constexpr double least_way = 3; // widths: else it is not sharp; and one limit, that no short edge is left
  if ((apart && !is_inside(topology, allowed, tip.sides[0], on_first)) ||
      !is_inside(topology, allowed, tip.sides[1], on_second) ||
      distance(cut, topology.vertex(vertices_of(topology, tip.sides[0]).front()).point) <
          std::max(least_way * on_second.distance, allowed.length(cut)))
    return false;
  if (apart)
    split(topology, tip.sides[0], on_first);
  split(topology, tip.sides[1], on_second);
  for (side& one : tip.sides)
    one.resize(1);
  return true;
}

/// The same, or the other way round: either side may be the one that ends first.
inline std::optional<strip> cut_either_where_apart(editable_topology& topology, const limits& allowed,
                                                   strip tip) {
  if (cut_where_apart(topology, allowed, tip))
    return tip;
  std::swap(tip.sides[0], tip.sides[1]);
  std::reverse(tip.ends[0].begin(), tip.ends[0].end());
  return cut_where_apart(topology, allowed, tip) ? std::optional(tip) : std::nullopt;
}

} // namespace detail

DOVETAIL_INLINE std::vector<turn_back> turns_of_face(const editable_topology& topology, const limits& allowed,
                                                     local_id f) {
  std::vector<turn_back> turns;
  const auto& loops = topology.loops(f);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const auto found = detail::turns_of_loop(topology, allowed, loops[l], l);
    turns.insert(turns.end(), found.begin(), found.end());
  }
  return turns;
}

DOVETAIL_INLINE std::optional<strip> strip_of_face(const editable_topology& topology, const limits& allowed,
                                                   local_id f) {
  const auto& loops = topology.loops(f);
  std::optional<strip> made;
  if (loops.size() == 1)
    made = detail::strip_of_loop(topology, allowed, loops[0]);
  else if (loops.size() == 2)
    made = detail::ring_of_loops(topology, loops[0], loops[1]);
  return made && detail::are_plain(topology, f, made->sides) ? made : std::nullopt;
}

DOVETAIL_INLINE std::optional<strip> narrow_end(editable_topology& topology, const limits& allowed,
                                                local_id f, const turn_back& turn) {
  const auto& loop = topology.loops(f)[turn.loop];
  strip made;
  made.is_tip = true;
  made.ends[0] = detail::curves_at(loop, turn);
  made.sides = {detail::turned_round(detail::along(loop, turn.before, 1)),
                detail::along(loop, turn.after, 1)};
  if (!detail::are_plain(topology, f, made.sides))
    return std::nullopt;
  return detail::cut_either_where_apart(topology, allowed, std::move(made));
}

DOVETAIL_INLINE std::optional<strip> narrow_gap(editable_topology& topology, const limits& allowed,
                                                const side_curve& first, const side_curve& second) {
  strip made;
  made.is_tip = true;
  made.sides = {side{first}, side{second}};
  return detail::cut_either_where_apart(topology, allowed, std::move(made));
}

DOVETAIL_INLINE bool has_narrow_end_at(const editable_topology& topology, const limits& allowed, local_id f,
                                       local_id c) {
  const auto has = [c](const std::vector<local_id>& end) {
    return std::find(end.begin(), end.end(), c) != end.end();
  };
  if (const auto whole = strip_of_face(topology, allowed, f);
      whole && std::any_of(whole->ends.begin(), whole->ends.end(), has) &&
      width_of(topology, allowed, *whole))
    return true;
  const auto turns = turns_of_face(topology, allowed, f);
  return std::any_of(turns.begin(), turns.end(), [&](const turn_back& turn) {
    if (!has(detail::curves_at(topology.loops(f)[turn.loop], turn)))
      return false;
    editable_topology trial = topology;
    return narrow_end(trial, allowed, f, turn).has_value();
  });
}

DOVETAIL_INLINE std::vector<local_id> vertices_of(const editable_topology& topology, const side& one) {
  std::vector<local_id> found;
  for (const side_curve& passed : one)
    found.push_back(topology.curve(passed.curve).vertices[passed.forward ? 0 : 1]);
  found.push_back(topology.curve(one.back().curve).vertices[one.back().forward ? 1 : 0]);
  return found;
}

DOVETAIL_INLINE place_on_side nearest_on(const editable_topology& topology, const side& one, vec3 p) {
  place_on_side best{0, 0, std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < one.size(); ++k)
    for (int i = 0; i < detail::samples_of_side; ++i) {
      const auto& curve = topology.curve(one[k].curve);
      const double t = detail::parameter_at(curve, i, detail::samples_of_side);
      const double away = distance(topology.point(one[k].curve, t), p);
      if (away < best.distance)
        best = {k, t, away};
    }
  const local_id c = one[best.curve].curve;
  const auto& range = topology.curve(c).t;
  const double found =
      std::clamp(topology.model().project_to_curve(topology.inner_curve(c), p, best.t), range[0], range[1]);
  const double away = distance(topology.point(c, found), p);
  return away < best.distance ? place_on_side{best.curve, found, away} : best;
}

DOVETAIL_INLINE void split(editable_topology& topology, side& one, const place_on_side& where) {
  const side_curve before = one[where.curve];
  const side_curve added{topology.split(before.curve, where.t), before.forward};
  const auto at = one.begin() + static_cast<std::ptrdiff_t>(where.curve);
  one.insert(before.forward ? at + 1 : at, added);
}

DOVETAIL_INLINE bool is_inside(const editable_topology& topology, const limits& allowed, const side& one,
                               const place_on_side& where) {
  const local_id c = one[where.curve].curve;
  const auto& range = topology.curve(c).t;
  const vec3 p = topology.point(c, where.t);
  constexpr double least_part = 1e-3;
  return where.t > range[0] && where.t < range[1] &&
         std::min(distance(p, topology.point(c, range[0])), distance(p, topology.point(c, range[1]))) >
             least_part * allowed.length(p);
}

DOVETAIL_INLINE std::optional<double> width_of(const editable_topology& topology, const limits& allowed,
                                               const strip& narrow) {
  double width = 0;
  for (const std::size_t from : {std::size_t{0}, std::size_t{1}})
    for (const side_curve& passed : narrow.sides[from])
      for (int i = 0; i < detail::samples_of_side; ++i) {
        const vec3 p = topology.point(
            passed.curve, detail::parameter_at(topology.curve(passed.curve), i, detail::samples_of_side));
        const double here = nearest_on(topology, narrow.sides[1 - from], p).distance;
        if (here > allowed.length(p))
          return std::nullopt;
        width = std::max(width, here);
      }
  return width;
}

} // namespace dovetail::virtual_topology
