/// @file
/// What `narrow_gaps.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/models/virtual/narrow_gaps.hpp"
#include "dovetail/models/virtual/strip_collapse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace dovetail::virtual_topology {

namespace detail {

/// A curve that is run from a vertex.
struct curve_from {
  local_id vertex;
  side_curve way;
};

inline local_id start_of(const editable_topology& topology, const side_curve& way) {
  return topology.curve(way.curve).vertices[way.forward ? 0 : 1];
}

inline vec3 direction_at_start(const editable_topology& topology, const side_curve& way) {
  return topology.direction({way.curve, !way.forward}, 0);
}

/// Both ways of each curve, vertex by vertex.
inline std::vector<curve_from> curves_from_vertices(const editable_topology& topology) {
  std::vector<curve_from> found;
  for (std::size_t k = 0; k < topology.curve_count(); ++k)
    if (const auto c = static_cast<local_id>(k); topology.is_used(c) && !topology.curve(c).degenerate)
      for (const side_curve way : {side_curve{c, true}, side_curve{c, false}})
        found.push_back({start_of(topology, way), way});
  std::stable_sort(found.begin(), found.end(),
                   [](const curve_from& a, const curve_from& b) { return a.vertex < b.vertex; });
  return found;
}

/// The solid in which the middle of a curve is left towards the other one: in front of the face that is next
/// to that direction, or behind it. None where that face goes that way itself.
inline local_id solid_towards(const editable_topology& topology, local_id c, local_id other) {
  constexpr double least_off = 0.2; // of the face: the sine of an angle
  const auto& t = topology.curve(c).t;
  const double middle = 0.5 * (t[0] + t[1]);
  const vec3 from = topology.point(c, middle);
  const place_on_side across = nearest_on(topology, {{other, true}}, from);
  const vec3 towards = normalized(topology.point(other, across.t) - from);
  double least = std::numeric_limits<double>::infinity();
  local_id solid = no_id;
  for (const passage& p : topology.passages_of(c)) {
    const virtual_coedge& coedge = topology.at(p);
    const double angle = angle_between(topology.inward(p.face, coedge, 0.5), towards);
    if (!(angle < least))
      continue;
    least = angle;
    const auto& face = topology.model().topology().faces[p.face];
    const surface_frame frame = topology.model().face_frame(p.face, topology.uv(coedge, middle));
    const double off = dot(normalized(cross(frame.du, frame.dv)), towards) * (face.reversed ? -1 : 1);
    solid = std::abs(off) < least_off ? no_id : face.solids[off > 0 ? 1 : 0];
  }
  return solid;
}

/// Whether there is the inside of one solid between the sides of a gap.
inline bool is_in_solid(const editable_topology& topology, const strip& gap) {
  const local_id first = gap.sides[0].front().curve, second = gap.sides[1].front().curve;
  const local_id solid = solid_towards(topology, first, second);
  return solid != no_id && solid == solid_towards(topology, second, first);
}

/// Whether two curves leave their vertex beside each other.
inline bool leave_together(const editable_topology& topology, const side_curve& first,
                           const side_curve& second) {
  constexpr double most_deg = 20; // a gap that opens faster is not narrow far enough
  return first.curve != second.curve &&
         angle_between(direction_at_start(topology, first), direction_at_start(topology, second)) <
             most_deg / degrees_per_radian;
}

/// The topology in which the gap between two curves from one vertex begins where it is wide enough.
inline std::optional<editable_topology> without_gap(const editable_topology& topology, const limits& allowed,
                                                    const side_curve& first, const side_curve& second,
                                                    std::vector<suppressed_detail>& found) {
  editable_topology trial = topology;
  const auto gap = narrow_gap(trial, allowed, first, second);
  if (!gap || !is_in_solid(trial, *gap))
    return std::nullopt;
  const auto width = width_of(trial, allowed, *gap);
  if (!width)
    return std::nullopt;
  auto made = collapsed(trial, allowed, no_id, *gap, *width);
  if (made)
    found.push_back({suppressed_detail::kind::narrow_gap, trial.inner_curve(first.curve),
                     trial.middle(gap->sides[0].front().curve), *width});
  return made;
}

} // namespace detail

DOVETAIL_INLINE std::size_t collapse_narrow_gaps(editable_topology& topology, const limits& allowed,
                                                 std::vector<suppressed_detail>& found) {
  const auto from_vertices = detail::curves_from_vertices(topology);
  const auto is_as_listed = [&](const detail::curve_from& one) { // curves are split and replaced meanwhile
    return topology.is_used(one.way.curve) && detail::start_of(topology, one.way) == one.vertex;
  };
  std::size_t count = 0;
  for (auto first = from_vertices.begin(); first != from_vertices.end(); ++first)
    for (auto second = first + 1; second != from_vertices.end() && second->vertex == first->vertex;
         ++second) {
      if (!is_as_listed(*first) || !is_as_listed(*second) ||
          !detail::leave_together(topology, first->way, second->way))
        continue;
      if (auto made = detail::without_gap(topology, allowed, first->way, second->way, found)) {
        topology = std::move(*made);
        ++count;
      }
    }
  return count;
}

} // namespace dovetail::virtual_topology
