/// @file
/// What `face_triangles.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/models/virtual/face_triangles.hpp"
#include "dovetail/remesh/constrained_triangulation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace dovetail::virtual_topology {

namespace detail {

inline constexpr double largest_turn = 15 / degrees_per_radian;             ///< between points of a boundary
inline constexpr double largest_turn_of_triangle = 30 / degrees_per_radian; ///< between its corners

/// Points of a face, growing, and their triangulation.
class face_points {
public:
  face_points(const any_geometry& model, local_id f) : model_(model), face_(f) {}

  /// A closed loop, with the face on its left.
  void add_loop(const std::vector<vec2>& uv) {
    const auto first = static_cast<local_id>(uv_.size());
    for (const vec2 at : uv)
      add(at);
    const auto end = static_cast<local_id>(uv_.size());
    for (local_id i = first; i < end; ++i)
      segments_.push_back({i, i + 1 < end ? i + 1 : first});
  }

  /// Triangles that follow the surface, with points inside where it takes them.
  std::optional<std::vector<charted_triangle>> run(const any_sizing& sag) {
    constexpr int most_rounds = 10;
    constexpr std::size_t most_points = 20'000;
    find_scales();
    for (int round = 0; round < most_rounds && uv_.size() < most_points; ++round) {
      if (!has_normals() || !triangulate())
        return std::nullopt;
      const std::size_t before = uv_.size();
      for (const simplex<2>& t : triangles_)
        if (turns(t) || sags(t, sag))
          add(middle_of(t));
      if (uv_.size() == before)
        return made();
    }
    return std::nullopt;
  }

private:
  void add(vec2 uv) {
    uv_.push_back(uv);
    frames_.push_back(model_.face_frame(face_, uv));
  }

  /// Lengths of the surface along both parameters.
  void find_scales() {
    for (const surface_frame& frame : frames_) {
      scale_.x += norm(frame.du) / static_cast<double>(frames_.size());
      scale_.y += norm(frame.dv) / static_cast<double>(frames_.size());
    }
  }

  bool has_normals() const {
    constexpr double least = 1e-6;
    return std::all_of(frames_.begin(), frames_.end(), [&](const surface_frame& frame) {
      return norm(cross(frame.du, frame.dv)) > least * scale_.x * scale_.y;
    });
  }

  bool triangulate() {
    std::vector<vec2> scaled;
    for (const vec2 uv : uv_)
      scaled.push_back({scale_.x * uv.x, scale_.y * uv.y});
    const loop_triangulation found = triangulate_loops(scaled, segments_);
    triangles_.clear();
    for (local_id t = 0; found.valid() && t < found.table.triangle_slots(); ++t)
      if (found.table.alive(t))
        triangles_.push_back(
            {found.table.vertex[3 * t], found.table.vertex[3 * t + 1], found.table.vertex[3 * t + 2]});
    return !triangles_.empty();
  }

  vec3 normal(local_id v) const { return cross(frames_[v].du, frames_[v].dv); }

  bool turns(const simplex<2>& t) const {
    for (const auto& [i, j] : {std::array{0, 1}, std::array{1, 2}, std::array{2, 0}})
      if (angle_between(normal(t[i]), normal(t[j])) > largest_turn_of_triangle)
        return true;
    return false;
  }

  vec2 middle_of(const simplex<2>& t) const { return (1.0 / 3) * (uv_[t[0]] + uv_[t[1]] + uv_[t[2]]); }

  bool sags(const simplex<2>& t, const any_sizing& sag) const {
    const vec3 flat = (frames_[t[0]].point + frames_[t[1]].point + frames_[t[2]].point) / 3;
    return distance(model_.face_point(face_, middle_of(t)), flat) > sag(flat);
  }

  std::vector<charted_triangle> made() const {
    std::vector<charted_triangle> all;
    for (const simplex<2>& t : triangles_) {
      charted_triangle& one = all.emplace_back(charted_triangle{face_});
      for (std::size_t i = 0; i < 3; ++i) {
        one.own[i] = uv_[t[i]];
        one.space[i] = frames_[t[i]].point;
      }
    }
    return all;
  }

  const any_geometry& model_;
  local_id face_;
  std::vector<vec2> uv_;
  std::vector<surface_frame> frames_; ///< by point
  std::vector<std::array<local_id, 2>> segments_;
  std::vector<simplex<2>> triangles_;
  vec2 scale_{};
};

} // namespace detail

DOVETAIL_INLINE vec3 face_triangles::normal(const virtual_coedge& coedge, double t) const {
  const surface_frame frame = topology_.model().face_frame(coedge.own_face, uv_(coedge, t));
  return cross(frame.du, frame.dv);
}

DOVETAIL_INLINE const std::optional<std::vector<charted_triangle>>& face_triangles::of_face(local_id f) {
  const auto known = faces_.find(f);
  return known != faces_.end() ? known->second : faces_.emplace(f, triangulated(f)).first->second;
}

DOVETAIL_INLINE const std::optional<std::vector<double>>& face_triangles::of_curve(local_id c) {
  const auto known = curves_.find(c);
  if (known != curves_.end())
    return known->second;
  auto& made = curves_[c];
  try {
    made = sampled(c);
  } catch (const geometry_error&) { // of a place where the kernel cannot evaluate a face
  }
  return made;
}

DOVETAIL_INLINE face_triangles::curve_sample face_triangles::sample_at(const std::vector<passage>& passages,
                                                                       double t) const {
  curve_sample made{t, {}};
  for (const passage& p : passages) {
    const virtual_coedge& coedge = topology_.at(p);
    const vec2 uv = uv_(coedge, t);
    const surface_frame frame = topology_.model().face_frame(coedge.own_face, uv);
    made.places.push_back({uv, frame.point, cross(frame.du, frame.dv)});
  }
  return made;
}

DOVETAIL_INLINE bool face_triangles::is_straight(const std::vector<passage>& passages,
                                                 const curve_sample& from, const curve_sample& middle,
                                                 const curve_sample& to) const {
  constexpr double share = 0.2; // of the sag of triangles
  for (std::size_t k = 0; k < passages.size(); ++k) {
    const place &first = from.places[k], &here = middle.places[k], &last = to.places[k];
    const double most = share * sag_(here.point);
    if (distance(here.point, midpoint(first.point, last.point)) > most ||
        angle_between(first.normal, last.normal) > detail::largest_turn)
      return false;
    const vec3 between =
        topology_.model().face_point(topology_.at(passages[k]).own_face, 0.5 * (first.uv + last.uv));
    if (!(distance(here.point, between) <= most))
      return false;
  }
  return true;
}

DOVETAIL_INLINE std::optional<std::vector<double>> face_triangles::sampled(local_id c) const {
  constexpr std::size_t least_parts = 4, most_parts = 256;
  constexpr double least_part = 1.0 / 4096; // of the parameters: at a kink no part is straight
  const auto& range = topology_.curve(c).t;
  const double width = range[1] - range[0];
  const auto passages = topology_.passages_of(c);
  std::vector<curve_sample> samples;
  for (std::size_t i = 0; i <= least_parts; ++i)
    samples.push_back(sample_at(
        passages, i < least_parts ? range[0] + width * static_cast<double>(i) / least_parts : range[1]));
  for (std::size_t i = 0; i + 1 < samples.size();) {
    const double from = samples[i].t, to = samples[i + 1].t;
    curve_sample middle = sample_at(passages, 0.5 * (from + to));
    if (is_straight(passages, samples[i], middle, samples[i + 1]))
      ++i;
    else if (samples.size() > most_parts || to - from < least_part * width)
      return std::nullopt;
    else
      samples.insert(samples.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::move(middle));
  }
  std::vector<double> t;
  for (const curve_sample& one : samples)
    t.push_back(one.t);
  return t;
}

DOVETAIL_INLINE std::optional<std::vector<charted_triangle>> face_triangles::triangulated(local_id f) {
  detail::face_points points(topology_.model(), f);
  std::vector<local_id> passed;
  try {
    for (const auto& loop : topology_.loops(f)) {
      std::vector<vec2> uv;
      for (const virtual_coedge& coedge : loop) {
        if (topology_.curve(coedge.curve).degenerate ||
            std::find(passed.begin(), passed.end(), coedge.curve) != passed.end())
          return std::nullopt;
        passed.push_back(coedge.curve);
        const auto& t = of_curve(coedge.curve);
        if (!t)
          return std::nullopt;
        for (std::size_t i = 0; i + 1 < t->size(); ++i)
          uv.push_back(uv_(coedge, coedge.reversed ? (*t)[t->size() - 1 - i] : (*t)[i]));
      }
      points.add_loop(uv);
    }
    return points.run(sag_);
  } catch (const geometry_error&) { // of a place where the kernel cannot evaluate it
    return std::nullopt;
  }
}

} // namespace dovetail::virtual_topology
