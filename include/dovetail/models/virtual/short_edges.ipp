/// @file
/// What `short_edges.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/models/virtual/short_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dovetail::virtual_topology {

namespace detail {

/// Where an edge of that length between two vertices may be given up, as far as these are concerned.
inline bool ends_can_meet(const editable_topology& topology, const limits& allowed, local_id c) {
  const auto& ends = topology.curve(c).vertices;
  if (ends[0] == ends[1])
    return false;
  const auto& first = topology.vertex(ends[0]);
  const auto& second = topology.vertex(ends[1]);
  if (std::max(topology.deviation_of_vertex(ends[0]), topology.deviation_of_vertex(ends[1])) +
          distance(first.point, second.point) >
      furthest_vertex * allowed.length(first.point))
    return false; // vertices that have taken in others already
  for (std::size_t other = 0; other < topology.curve_count(); ++other) {
    const auto id = static_cast<local_id>(other);
    if (id == c || !topology.is_used(id) || topology.curve(id).degenerate)
      continue;
    const auto& theirs = topology.curve(id).vertices;
    if (std::minmax(theirs[0], theirs[1]) == std::minmax(ends[0], ends[1]))
      return false; // it would close
  }
  return true;
}

/// Whether a boundary turns away from its face where it goes on to the next coedge.
inline bool turns_away(const editable_topology& topology, local_id f, const virtual_coedge& from,
                       const virtual_coedge& to) {
  return dot(topology.inward(f, from, 1), topology.direction(to, 0)) < 0;
}

} // namespace detail

DOVETAIL_INLINE bool is_short(const editable_topology& topology, const limits& allowed, local_id c) {
  return topology.length(c) <= allowed.length(topology.middle(c));
}

DOVETAIL_INLINE bool can_be_dropped(const editable_topology& topology, const limits& allowed,
                                    const passage& p) {
  const auto& loop = topology.loops(p.face)[p.loop];
  const std::size_t count = loop.size();
  const virtual_coedge& gone = loop[p.place];
  if (count < 3 || topology.length_of_loop(p) < least_loop * allowed.length(topology.middle(gone.curve)))
    return false;
  const virtual_coedge& before = loop[(p.place + count - 1) % count];
  const virtual_coedge& after = loop[(p.place + 1) % count];
  if (topology.curve(before.curve).degenerate || topology.curve(after.curve).degenerate)
    return false;
  const auto turn = [&](const virtual_coedge& from, const virtual_coedge& to) {
    return angle_between(topology.direction(from, 1), topology.direction(to, 0));
  };
  constexpr double same = 0.02; // radians, by which curves bend: a corner that is as sharp already only moves
  const double at_start = turn(before, gone), at_end = turn(gone, after);
  if (turn(before, after) <= std::max({std::numbers::pi - allowed.least_corner_deg / degrees_per_radian,
                                       at_start + same, at_end + same}))
    return true;
  // The face is all around the corner, as where it ends at a slit.
  return detail::turns_away(topology, p.face, before, gone) &&
         detail::turns_away(topology, p.face, gone, after) && at_start + at_end <= std::numbers::pi + same;
}

DOVETAIL_INLINE bool keeps_faces(const editable_topology& before, const editable_topology& after,
                                 const limits& allowed) {
  return std::all_of(allowed.kept_faces.begin(), allowed.kept_faces.end(), [&](local_id f) {
    return std::equal(before.loops(f).begin(), before.loops(f).end(), after.loops(f).begin(),
                      after.loops(f).end(), [&](const auto& a, const auto& b) {
                        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                                          [&](const virtual_coedge& x, const virtual_coedge& y) {
                                            return x.curve == y.curve && before.ends(x) == after.ends(y);
                                          });
                      });
  });
}

DOVETAIL_INLINE std::size_t collapse_short_edges(editable_topology& topology, const limits& allowed,
                                                 std::vector<suppressed_detail>& found) {
  std::vector<std::pair<double, local_id>> waiting;
  for (std::size_t k = 0; k < topology.curve_count(); ++k)
    if (const auto c = static_cast<local_id>(k);
        topology.is_used(c) && !topology.curve(c).degenerate && is_short(topology, allowed, c))
      waiting.emplace_back(topology.length(c), c);
  std::sort(waiting.begin(), waiting.end());
  std::size_t count = 0;
  for (const auto& [length, c] : waiting) {
    const auto passages = topology.passages_of(c);
    if (!detail::ends_can_meet(topology, allowed, c) ||
        !std::all_of(passages.begin(), passages.end(),
                     [&](const passage& p) { return can_be_dropped(topology, allowed, p); }))
      continue;
    auto [kept, gone] = topology.curve(c).vertices;
    if (topology.curves_at(gone) > topology.curves_at(kept))
      std::swap(kept, gone);
    editable_topology trial = topology;
    trial.drop_all(c, kept);
    if (!trial.has_long_curves() || !keeps_faces(topology, trial, allowed))
      continue;
    found.push_back(
        {suppressed_detail::kind::short_edge, topology.inner_curve(c), topology.middle(c), length});
    topology = std::move(trial);
    ++count;
  }
  return count;
}

} // namespace dovetail::virtual_topology
