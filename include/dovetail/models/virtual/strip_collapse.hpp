/// @file
/// Two sides beside each other become one curve.
#pragma once

#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/models/virtual/strip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::virtual_topology::detail {

/// One attempt to make a curve of a strip, on a copy of the topology.
class strip_collapse {
public:
  /// \param f the face between the sides, or no_id
  strip_collapse(const editable_topology& given, const limits& allowed, local_id f, strip narrow,
                 double width)
      : topology_(given), allowed_(allowed), face_(f), narrow_(std::move(narrow)), width_(width) {}

  /// Nothing where it must not be.
  std::optional<editable_topology> run() {
    if ((is_end_of_face() && !face_goes_on()) || !ends_can_be_dropped() ||
        (narrow_.is_ring && !start_beside()) || !pair_vertices() || !faces_can_meet() ||
        !second_side_can_move())
      return std::nullopt;
    const std::array vertices{vertices_of(topology_, narrow_.sides[0]),
                              vertices_of(topology_, narrow_.sides[1])};
    if (is_end_of_face())
      cut_tip(vertices);
    else if (face_ != no_id)
      topology_.remove_face(face_);
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
      drop_end(narrow_.ends[end], end == 0 ? vertices[0].front() : vertices[0].back());
    for (std::size_t k = 0; k < narrow_.sides[0].size(); ++k) {
      const auto [kept, gone] = std::pair(narrow_.sides[0][k], narrow_.sides[1][k]);
      topology_.replace_curve(gone.curve, kept.curve, gone.forward == kept.forward, width_);
    }
    for (std::size_t k = 0; k < vertices[0].size(); ++k)
      topology_.merge_vertices(vertices[1][k], vertices[0][k]);
    return topology_.has_closed_loops() && topology_.has_long_curves() && stays_near()
               ? std::optional(std::move(topology_))
               : std::nullopt;
  }

private:
  static constexpr double slit_deg = 10; ///< walls of a slit go on along each other

  bool is_end_of_face() const { return narrow_.is_tip && face_ != no_id; }
  vec3 point_of(local_id v) const { return topology_.vertex(v).point; }
  double limit_at(local_id v) const { return allowed_.length(point_of(v)); }

  /// The edges between the sides leave the other faces at them in order; a strip that goes on there, and is
  /// narrow itself, may get a tip.
  bool ends_can_be_dropped() const {
    for (const auto& end : narrow_.ends)
      for (const local_id c : end)
        for (const passage& p : topology_.passages_of(c))
          if (p.face != face_ && !can_be_dropped(topology_, allowed_, p) &&
              !has_narrow_end_at(topology_, allowed_, p.face, c))
            return false;
    return true;
  }

  /// The second side of a ring starts beside the first one, at a vertex that it gets there if need be.
  bool start_beside() {
    const local_id start = vertices_of(topology_, narrow_.sides[0]).front();
    side& second = narrow_.sides[1];
    const auto vertices = vertices_of(topology_, second);
    for (std::size_t k = 0; k < second.size(); ++k)
      if (distance(point_of(vertices[k]), point_of(start)) <= limit_at(start)) {
        std::rotate(second.begin(), second.begin() + static_cast<std::ptrdiff_t>(k), second.end());
        return true;
      }
    const place_on_side where = nearest_on(topology_, second, point_of(start));
    if (!is_inside(topology_, allowed_, second, where))
      return false;
    split(topology_, second, where);
    std::rotate(second.begin(), second.begin() + static_cast<std::ptrdiff_t>(where.curve) + 1, second.end());
    return true;
  }

  /// Both sides have vertices beside each other afterwards; false where they do not come in one order.
  bool pair_vertices() {
    for (const std::size_t from : {std::size_t{0}, std::size_t{1}}) {
      const std::size_t to = 1 - from;
      const auto given = vertices_of(topology_, narrow_.sides[from]);
      for (std::size_t k = 1; k + 1 < given.size(); ++k) {
        const auto there = vertices_of(topology_, narrow_.sides[to]);
        if (std::any_of(there.begin() + 1, there.end() - 1, [&](local_id v) {
              return distance(point_of(v), point_of(given[k])) <= limit_at(given[k]);
            }))
          continue;
        const place_on_side where = nearest_on(topology_, narrow_.sides[to], point_of(given[k]));
        if (!is_inside(topology_, allowed_, narrow_.sides[to], where))
          return false;
        split(topology_, narrow_.sides[to], where);
      }
    }
    return vertices_of(topology_, narrow_.sides[0]).size() == vertices_of(topology_, narrow_.sides[1]).size();
  }

  /// No face was moved by more than the limit, and no vertex by much more, in how many steps ever.
  bool stays_near() const {
    const auto vertices = vertices_of(topology_, narrow_.sides[0]);
    return std::all_of(narrow_.sides[0].begin(), narrow_.sides[0].end(),
                       [&](const side_curve& kept) {
                         return topology_.deviation_of_curve(kept.curve) <=
                                allowed_.length(topology_.middle(kept.curve));
                       }) &&
           std::all_of(vertices.begin(), vertices.end(), [&](local_id v) {
             return topology_.deviation_of_vertex(v) <= furthest_vertex * limit_at(v);
           });
  }

  /// Whether faces behind the second side are wide enough to end at the first one instead.
  bool second_side_can_move() const {
    for (std::size_t k = 0; k < narrow_.sides[1].size(); ++k)
      for (const passage& p : topology_.passages_of(narrow_.sides[1][k].curve))
        if (p.face != face_ && !is_wide(p, narrow_.sides[0][k].curve))
          return false;
    return true;
  }

  /// Whether the rest of a face's boundary is further from the curve that a passage is moved to than the
  /// passage is, but where it goes on from that passage without turning back: else the face would fold.
  bool is_wide(const passage& p, local_id moved_to) const {
    constexpr int samples = 9;
    constexpr double least = 1.1; // widths
    const auto points = topology_.samples(moved_to, samples);
    const auto& loops = topology_.loops(p.face);
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (std::size_t k = 0; k < loops[l].size(); ++k) {
        const virtual_coedge& other = loops[l][k];
        if ((l == p.loop && (k == p.place || goes_on_to(p, k))) || topology_.curve(other.curve).degenerate)
          continue;
        const std::vector<vec3> ends = topology_.samples(other.curve, 2);
        for (const vec3& point : points)
          if (may_be_within(least * width_, point, other.curve, ends) &&
              nearest_on(topology_, {{other.curve, true}}, point).distance < least * width_)
            return false;
      }
    return true;
  }

  /// False where the way from one end of a curve by a point near it to the other end would be longer than the
  /// curve, which holds for most.
  bool may_be_within(double limit, vec3 p, local_id c, std::span<const vec3> ends) const {
    constexpr double chords = 1.05; // the length is that of chords
    return distance(p, ends[0]) + distance(p, ends[1]) <= chords * topology_.length(c) + 2 * limit;
  }

  /// Whether another coedge of its loop has a vertex in common with a passage, and they do not follow each
  /// other at a sharp corner. Around a seam they need not follow each other.
  bool goes_on_to(const passage& p, std::size_t other) const {
    const auto& loop = topology_.loops(p.face)[p.loop];
    const double sharp = std::numbers::pi - allowed_.least_angle_deg / degrees_per_radian;
    const auto is_sharp = [&](std::size_t first, std::size_t second) {
      return (first + 1) % loop.size() == second &&
             angle_between(topology_.direction(loop[first], 1), topology_.direction(loop[second], 0)) >=
                 sharp;
    };
    const auto own = topology_.ends(loop[p.place]), theirs = topology_.ends(loop[other]);
    const bool touch = std::find_first_of(own.begin(), own.end(), theirs.begin(), theirs.end()) != own.end();
    return touch && !is_sharp(p.place, other) && !is_sharp(other, p.place);
  }

  /// The faces behind the two sides do not fold onto each other, unless nothing is meshed between them, and
  /// there is one: a sheet of its own stays.
  bool faces_can_meet() const {
    bool has_neighbour = false;
    const auto passages_behind = [&](const side_curve& passed) {
      auto found = topology_.passages_of(passed.curve);
      std::erase_if(found, [&](const passage& p) { return p.face == face_; });
      has_neighbour = has_neighbour || !found.empty();
      return found;
    };
    for (std::size_t k = 0; k < narrow_.sides[0].size(); ++k) {
      const auto behind_second = passages_behind(narrow_.sides[1][k]);
      for (const passage& p : passages_behind(narrow_.sides[0][k]))
        for (const passage& q : behind_second)
          if (p.face == q.face || !can_meet(p, q))
            return false;
    }
    return has_neighbour;
  }

  bool can_meet(const passage& p, const passage& q) const {
    const virtual_coedge &first = topology_.at(p), &second = topology_.at(q);
    const auto& t = topology_.curve(first.curve).t;
    const auto& range = topology_.curve(second.curve).t;
    for (const double share : {0.1, 0.5, 0.9}) {
      const double along = first.reversed ? 1 - share : share;
      const double here = t[0] + along * (t[1] - t[0]);
      const vec3 on_first = topology_.point(first.curve, here);
      const place_on_side beside = nearest_on(topology_, {{second.curve, true}}, on_first);
      const double there = (beside.t - range[0]) / (range[1] - range[0]);
      const double angle =
          degrees_per_radian *
          angle_between(topology_.inward(p.face, first, share),
                        topology_.inward(q.face, second, second.reversed ? 1 - there : there));
      const vec3 across = topology_.point(second.curve, beside.t) - on_first;
      if (angle < allowed_.least_angle_deg &&
          !(angle < slit_deg && is_at_slit(p, here, across) && is_at_slit(q, beside.t, -across)))
        return false;
    }
    return true;
  }

  /// Whether the strip is the bottom of a slit, and a passage one of a wall, as far as one wall can tell at
  /// parameter t: the face is between the walls, no solid is, and `across`, to the other wall, is about as
  /// far as the strip is wide. No element is in the angle that it leaves. Where a wing ends is no slit,
  /// though nothing is meshed in it: that runs into a point.
  bool is_at_slit(const passage& p, double t, vec3 across) const {
    constexpr double least_width = 0.5; // of the largest one
    constexpr double least_off = 0.2;   // of the face: the sine of an angle
    const auto& face = topology_.model().topology().faces[p.face];
    const surface_frame frame = topology_.model().face_frame(p.face, topology_.uv(topology_.at(p), t));
    const double off =
        dot(normalized(cross(frame.du, frame.dv)), normalized(across)) * (face.reversed ? -1 : 1);
    const std::size_t front = off > 0 ? 1 : 0;
    return norm(across) >= least_width * width_ && std::abs(off) >= least_off &&
           face.solids[front] == no_id && face.solids[1 - front] != no_id &&
           goes_across(topology_.at(p).curve, t, across);
  }

  /// Whether the strip's face is on that side of one of its curves.
  bool goes_across(local_id c, double t, vec3 across) const {
    const auto passages = topology_.passages_of(c);
    const auto own =
        std::find_if(passages.begin(), passages.end(), [&](const passage& p) { return p.face == face_; });
    if (own == passages.end())
      return false;
    const auto& range = topology_.curve(c).t;
    const double along = (t - range[0]) / (range[1] - range[0]);
    const virtual_coedge& coedge = topology_.at(*own);
    return dot(topology_.inward(face_, coedge, coedge.reversed ? 1 - along : along), across) > 0;
  }

  /// Whether what is left of the loop, once its tip is cut, bounds something.
  bool face_goes_on() const {
    const auto of_side = [](const side& one, local_id c) {
      return std::any_of(one.begin(), one.end(), [c](const side_curve& passed) { return passed.curve == c; });
    };
    for (const auto& loop : topology_.loops(face_)) {
      std::size_t left = 0;
      double length = 0;
      for (const virtual_coedge& coedge : loop)
        if (!of_side(narrow_.sides[0], coedge.curve) && !of_side(narrow_.sides[1], coedge.curve) &&
            !std::count(narrow_.ends[0].begin(), narrow_.ends[0].end(), coedge.curve)) {
          ++left;
          length += topology_.length(coedge.curve);
        }
      const local_id cut = narrow_.sides[0].back().curve;
      if (left < loop.size() && (left < 2 || length < least_loop * allowed_.length(topology_.middle(cut))))
        return false;
    }
    return true;
  }

  /// The face ends where the sides do: its second side starts at the vertex of the first one that stays.
  void cut_tip(const std::array<std::vector<local_id>, 2>& vertices) {
    std::vector<local_id> gone = narrow_.ends[0];
    for (const side& one : narrow_.sides)
      for (const side_curve& passed : one)
        gone.push_back(passed.curve);
    topology_.cut_out(face_, gone, vertices[0].back());
  }

  /// Edges from the first side to the second become the vertex that is kept.
  void drop_end(const std::vector<local_id>& curves, local_id kept) {
    for (const local_id c : curves)
      topology_.drop_all(c, kept);
  }

  editable_topology topology_;
  const limits& allowed_;
  local_id face_;
  strip narrow_;
  double width_;
};

/// The topology without the strip: one of its sides stays, the first one if it may.
inline std::optional<editable_topology> collapsed(const editable_topology& topology, const limits& allowed,
                                                  local_id f, strip narrow, double width) {
  if (auto made = strip_collapse(topology, allowed, f, narrow, width).run();
      made && keeps_faces(topology, *made, allowed))
    return made;
  std::swap(narrow.sides[0], narrow.sides[1]);
  for (auto& end : narrow.ends)
    std::reverse(end.begin(), end.end());
  auto made = strip_collapse(topology, allowed, f, std::move(narrow), width).run();
  return made && keeps_faces(topology, *made, allowed) ? std::move(made) : std::nullopt;
}

} // namespace dovetail::virtual_topology::detail
