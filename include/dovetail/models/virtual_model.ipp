/// @file
/// What `virtual_model.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/models/virtual/composite_faces.hpp"
#include "dovetail/models/virtual/editable_topology.hpp"
#include "dovetail/models/virtual/narrow_faces.hpp"
#include "dovetail/models/virtual/narrow_gaps.hpp"
#include "dovetail/models/virtual/short_edges.hpp"
#include "dovetail/models/virtual/tiny_faces.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "dovetail/sizing/bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dovetail {

namespace detail {

/// How the end of a curve bends to where its vertex is now.
struct bent_end {
  vec3 from{};         ///< where the model's curve ends
  vec3 by{};           ///< from there to the vertex
  double reach = 0;    ///< how far from there the curve is bent; 0: not at all
  bool evenly = false; ///< as far as it goes, since it is short

  /// The part of `by` that a point of the model's curve is moved by, and how that changes with its distance.
  std::array<double, 2> share_at(vec3 p) const {
    const double left = reach > 0 ? 1 - distance(p, from) / reach : 0;
    if (left <= 0)
      return {0, 0};
    return evenly ? std::array{left, -1 / reach} : std::array{left * left, -2 * left / reach};
  }
};

} // namespace detail

struct virtual_model::data {
  geometry_topology topology;
  std::vector<local_id> inner_curve;                                  ///< by curve
  std::vector<std::array<detail::bent_end, 2>> bent;                  ///< by curve
  std::vector<std::vector<virtual_topology::virtual_coedge>> coedges; ///< by face
  std::vector<suppressed_detail> suppressed;
  std::vector<virtual_topology::composite_face> composites;
  std::vector<std::size_t> composite_of; ///< by face of the model: the composite that it is of, or none
  std::vector<std::vector<std::array<vec2, 2>>> closing; ///< by face, of composites by coedge: at its ends
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// What the topology, and the model, say of boundaries.
  void take(const any_geometry& model, const virtual_topology::editable_topology& edited) {
    topology = edited.topology();
    inner_curve.clear();
    for (std::size_t c = 0; c < edited.curve_count(); ++c)
      inner_curve.push_back(edited.inner_curve(static_cast<local_id>(c)));
    coedges.assign(edited.face_count(), {});
    for (std::size_t f = 0; f < edited.face_count(); ++f)
      for (const auto& loop : edited.loops(static_cast<local_id>(f)))
        coedges[f].insert(coedges[f].end(), loop.begin(), loop.end());
    bent.clear();
    bend_curves(model, edited);
    widen_at_corners(model);
  }

  /// Joins faces of a topology that was taken.
  void join(const any_geometry& model, virtual_topology::editable_topology& edited,
            const virtual_topology::limits& allowed, double most_turn_deg) {
    composites = virtual_topology::join_faces(
        edited, allowed, most_turn_deg,
        [&](const virtual_topology::virtual_coedge& coedge, double t) { return own_uv(model, coedge, t); },
        suppressed);
    composite_of.assign(edited.face_count(), none);
    for (std::size_t k = 0; k < composites.size(); ++k)
      for (const local_id member : composites[k].members)
        composite_of[member] = k;
    if (!composites.empty())
      take(model, edited);
    closing.assign(edited.face_count(), {});
    for (const auto& composite : composites)
      close_loops(model, composite);
  }

  /// Members need not have a vertex at just the same point: what is missing at the end of a passage to where
  /// the next one starts is added all along its curve.
  void close_loops(const any_geometry& model, const virtual_topology::composite_face& composite) {
    const auto& all = coedges[composite.host];
    auto& missing = closing[composite.host];
    missing.assign(all.size(), {});
    const auto end_of = [&](const virtual_topology::virtual_coedge& coedge, bool at_start) {
      const double t = topology.curves[coedge.curve].t[coedge.reversed == at_start ? 1 : 0];
      return model.face_point(coedge.own_face, own_uv(model, coedge, t));
    };
    std::size_t first = 0;
    for (const auto& loop : topology.faces[composite.host].loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const auto& coedge = all[first + i];
        const vec3 here = end_of(coedge, false), next = end_of(all[first + (i + 1) % loop.size()], true);
        missing[first + i][coedge.reversed ? 0 : 1] = composite.chart.flat(next) - composite.chart.flat(here);
        topology.curves[coedge.curve].tolerance += distance(here, next);
      }
      first += loop.size();
    }
  }

  /// Parameters on a composite.
  vec2 uv_on(const any_geometry& model, const virtual_topology::composite_face& composite, int k,
             double t) const {
    const auto& coedge = coedges[composite.host][k];
    const auto& range = topology.curves[coedge.curve].t;
    const auto& missing = closing[composite.host][k];
    const vec3 p = model.face_point(coedge.own_face, own_uv(model, coedge, t));
    const double share = (t - range[0]) / (range[1] - range[0]);
    return composite.chart.flat(p) + (1 - share) * missing[0] + share * missing[1];
  }

  /// The composite that a number stands for, if it does.
  const virtual_topology::composite_face* composite(local_id f) const {
    const std::size_t k = composite_of.empty() ? none : composite_of[f];
    return k != none && composites[k].host == f ? &composites[k] : nullptr;
  }

  /// Where a passage is in the parameter plane of the model's face.
  vec2 own_uv(const any_geometry& model, const virtual_topology::virtual_coedge& coedge, double t) const {
    const local_id inner = inner_curve[coedge.curve];
    const auto uv_at = [&](double at) {
      return model.curve_uv(coedge.own_face, coedge.own,
                            virtual_topology::own_parameter(model, inner, coedge, at));
    };
    const vec2 uv = uv_at(t);
    vec2 moved = uv;
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
      if (coedge.corners[end]) {
        const double at_end = topology.curves[coedge.curve].t[end];
        const auto& bends = bent[coedge.curve][end];
        const double share = t == at_end ? 1 : bends.share_at(model.curve_point(inner, t))[0];
        if (share > 0)
          moved = moved + share * (*coedge.corners[end] - uv_at(at_end));
      }
    return moved;
  }

  void bend_curves(const any_geometry& model, const virtual_topology::editable_topology& edited) {
    // In displacements of its end. Where that is moved across, a curve turns by about 20 degrees at most; one
    // that would bend beyond its middle by more, up to 34, so that what is left of a strip ends bluntly and
    // is no wedge all along.
    constexpr double reach = 6;
    constexpr double least_reach = 3; // a shorter curve bends evenly
    bent.resize(topology.curves.size());
    for (std::size_t c = 0; c < topology.curves.size(); ++c) {
      auto& curve = topology.curves[c];
      const auto id = static_cast<local_id>(c);
      if (curve.degenerate || !edited.is_used(id))
        continue;
      for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
        if (edited.deviation_of_vertex(edited.curve(id).vertices[end]) == 0)
          continue; // what the model itself has apart stays so
        const vec3 vertex = topology.vertices[curve.vertices[end]].point;
        const vec3 from = model.curve_point(inner_curve[c], curve.t[end]);
        const double moved = distance(vertex, from);
        const double chord = distance(from, model.curve_point(inner_curve[c], curve.t[1 - end]));
        const bool is_short = chord > 0 && chord < 2 * least_reach * moved;
        const double most = chord > 0 ? 0.5 * chord : reach * moved;
        bent[c][end] = {from, vertex - from, is_short ? chord : std::min(reach * moved, most), is_short};
        curve.tolerance += moved;
      }
    }
  }

  /// A face that goes on to where an edge was has its corner there: its passages are off by as much at most.
  void widen_at_corners(const any_geometry& model) {
    for (const auto& of_face : coedges)
      for (const auto& coedge : of_face)
        for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
          if (!coedge.corners[end])
            continue;
          auto& curve = topology.curves[coedge.curve];
          const double own =
              virtual_topology::own_parameter(model, inner_curve[coedge.curve], coedge, curve.t[end]);
          curve.tolerance +=
              distance(model.face_point(coedge.own_face, *coedge.corners[end]),
                       model.face_point(coedge.own_face, model.curve_uv(coedge.own_face, coedge.own, own)));
        }
  }
};

DOVETAIL_INLINE virtual_model::virtual_model(any_geometry model, const any_sizing& size,
                                             const virtual_options& options)
    : model_(std::move(model)) {
  sizing::checked_length(options.share_of_size, "the share of the size that details have");
  sizing::checked_length(options.least_angle_deg, "the least angle beside details");
  sizing::checked_length(options.least_corner_deg, "the least angle of corners beside details");
  sizing::checked_length(options.share_of_folded, "the share of the size that folded faces have");
  sizing::checked_length(options.share_of_joined, "the share of the size that faces joined to others have");
  sizing::checked_length(options.most_turn_deg, "the turn of faces that are joined");
  const auto up_to = [&](double share) {
    return virtual_topology::limits{[&size, share](vec3 p) { return share * size(p); },
                                    options.least_angle_deg, options.least_corner_deg, options.kept_faces};
  };
  const virtual_topology::limits allowed = up_to(options.share_of_size);
  const virtual_topology::limits of_folded =
      up_to(options.share_of_size > 0 ? std::max(options.share_of_size, options.share_of_folded) : 0);
  auto made = std::make_shared<data>();
  virtual_topology::editable_topology topology(&model_);
  std::size_t found = 1;
  while (found > 0) { // a face that is gone leaves edges that are short now, and the other way round
    found = collapse_short_edges(topology, allowed, made->suppressed);
    found += collapse_tiny_faces(topology, allowed, made->suppressed);
    found += collapse_narrow_faces(topology, allowed, made->suppressed);
    found += collapse_folded_faces(topology, of_folded, made->suppressed);
    found += collapse_narrow_ends(topology, allowed, made->suppressed);
    found += collapse_narrow_gaps(topology, allowed, made->suppressed);
  }
  made->take(model_, topology);
  if (options.share_of_joined > 0)
    made->join(model_, topology, up_to(options.share_of_joined), options.most_turn_deg);
  data_ = std::move(made);
}

DOVETAIL_INLINE const geometry_topology& virtual_model::topology() const {
  return data_->topology;
}

DOVETAIL_INLINE const std::vector<suppressed_detail>& virtual_model::suppressed() const {
  return data_->suppressed;
}

DOVETAIL_INLINE vec3 virtual_model::curve_point(local_id c, double t) const {
  const vec3 p = model_.curve_point(data_->inner_curve[c], t);
  vec3 moved = p;
  for (const auto& end : data_->bent[c])
    moved += end.share_at(p)[0] * end.by;
  return moved;
}

DOVETAIL_INLINE curve_frame virtual_model::curve_frame(local_id c, double t) const {
  const dovetail::curve_frame given = model_.curve_frame(data_->inner_curve[c], t);
  dovetail::curve_frame moved = given;
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const detail::bent_end& end = data_->bent[c][i];
    const auto [share, slope] = end.share_at(given.point);
    const double away = distance(given.point, end.from);
    const double leaving = away > 0 ? dot(given.point - end.from, given.derivative) / away
                           : i == 0 ? norm(given.derivative)
                                    : -norm(given.derivative);
    moved.point += share * end.by;
    moved.derivative += (slope * leaving) * end.by;
  }
  return moved;
}

DOVETAIL_INLINE vec2 virtual_model::curve_uv(local_id f, int k, double t) const {
  const auto* joined = data_->composite(f);
  return joined ? data_->uv_on(model_, *joined, k, t) : data_->own_uv(model_, data_->coedges[f][k], t);
}

DOVETAIL_INLINE vec3 virtual_model::face_point(local_id f, vec2 uv) const {
  const auto* joined = data_->composite(f);
  return joined ? joined->chart.point(model_, uv) : model_.face_point(f, uv);
}

DOVETAIL_INLINE surface_frame virtual_model::face_frame(local_id f, vec2 uv) const {
  const auto* joined = data_->composite(f);
  return joined ? joined->chart.frame(model_, uv) : model_.face_frame(f, uv);
}

DOVETAIL_INLINE double virtual_model::face_curvature(local_id f, vec2 uv) const {
  const auto* joined = data_->composite(f);
  return joined ? joined->chart.curvature(model_, uv) : model_.face_curvature(f, uv);
}

DOVETAIL_INLINE vec2 virtual_model::project_to_face(local_id f, vec3 p, vec2 seed) const {
  const auto* joined = data_->composite(f);
  return joined ? joined->chart.project(model_, p) : model_.project_to_face(f, p, seed);
}

DOVETAIL_INLINE std::optional<surface_frame> virtual_model::plane_of_face(local_id f) const {
  const auto* joined = data_->composite(f);
  return joined ? joined->chart.plane() : model_.plane_of_face(f);
}

DOVETAIL_INLINE local_id virtual_model::face_at(local_id f, vec3 p) const {
  const auto* joined = data_->composite(f);
  return model_.face_at(joined ? joined->chart.face_at(p) : f, p);
}

DOVETAIL_INLINE local_id virtual_model::whole_face(local_id f) const {
  const local_id whole = model_.whole_face(f);
  const std::size_t k = data_->composite_of.empty() ? data::none : data_->composite_of[whole];
  return k == data::none ? whole : data_->composites[k].host;
}

DOVETAIL_INLINE double virtual_model::project_to_curve(local_id c, vec3 p, double seed) const {
  const auto& range = data_->topology.curves[c].t;
  double t = std::clamp(model_.project_to_curve(data_->inner_curve[c], p, seed), range[0], range[1]);
  if (data_->bent[c][0].reach == 0 && data_->bent[c][1].reach == 0)
    return t;
  constexpr int most_steps = 30; // of Gauss and Newton
  for (int step = 0; step < most_steps; ++step) {
    const auto [point, derivative] = curve_frame(c, t);
    const double square = norm_squared(derivative);
    const double next =
        square > 0 ? std::clamp(t + dot(p - point, derivative) / square, range[0], range[1]) : t;
    if (next == t)
      break;
    t = next;
  }
  return t;
}

DOVETAIL_INLINE report virtual_model::summary() const {
  suppression_counts counts;
  for (const suppressed_detail& one : data_->suppressed) {
    ++(one.what == suppressed_detail::kind::narrow_face  ? counts.narrow_faces
       : one.what == suppressed_detail::kind::narrow_end ? counts.narrow_ends
       : one.what == suppressed_detail::kind::narrow_gap ? counts.narrow_gaps
       : one.what == suppressed_detail::kind::short_edge ? counts.short_edges
                                                         : counts.joined_faces);
    if (one.what != suppressed_detail::kind::joined_face)
      counts.largest = std::max(counts.largest, one.length);
  }
  report made;
  made.name = "virtual topology";
  made.set(counts);
  return made;
}

} // namespace dovetail
