/// @file
/// What `virtual_model.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/models/virtual/editable_topology.hpp"
#include "dovetail/models/virtual/narrow_faces.hpp"
#include "dovetail/models/virtual/short_edges.hpp"
#include "dovetail/models/virtual/tiny_faces.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "dovetail/sizing/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dovetail {

namespace detail {

/// How the end of a curve bends to where its vertex is now.
struct bent_end {
  vec3 from{};      ///< where the model's curve ends
  vec3 by{};        ///< from there to the vertex
  double reach = 0; ///< how far from there the curve is bent; 0: not at all

  /// The part of `by` that a point of the model's curve is moved by, and how that changes with its distance.
  std::array<double, 2> share_at(vec3 p) const {
    const double left = reach > 0 ? 1 - distance(p, from) / reach : 0;
    return left > 0 ? std::array{left * left, -2 * left / reach} : std::array{0.0, 0.0};
  }
};

} // namespace detail

struct virtual_model::data {
  geometry_topology topology;
  std::vector<local_id> inner_curve;                                  ///< by curve
  std::vector<std::array<detail::bent_end, 2>> bent;                  ///< by curve
  std::vector<std::vector<virtual_topology::virtual_coedge>> coedges; ///< by face
  std::vector<suppressed_detail> suppressed;

  void bend_curves(const any_geometry& model, const virtual_topology::editable_topology& edited) {
    constexpr double reach = 6; // displacements: the curve turns by no more than about 20 degrees
    bent.resize(topology.curves.size());
    for (std::size_t c = 0; c < topology.curves.size(); ++c)
      for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
        const auto& curve = topology.curves[c];
        if (curve.degenerate || !edited.is_used(static_cast<local_id>(c)))
          continue;
        const vec3 vertex = topology.vertices[curve.vertices[end]].point;
        if (edited.deviation_of_vertex(edited.curve(static_cast<local_id>(c)).vertices[end]) == 0)
          continue; // what the model itself has apart stays so
        const vec3 from = model.curve_point(inner_curve[c], curve.t[end]);
        const double moved = distance(vertex, from);
        bent[c][end] = {from, vertex - from,
                        std::min(reach * moved, 0.5 * edited.length(static_cast<local_id>(c)))};
      }
  }
};

DOVETAIL_INLINE virtual_model::virtual_model(any_geometry model, const any_sizing& size,
                                             const virtual_options& options)
    : model_(std::move(model)) {
  sizing::checked_length(options.share_of_size, "the share of the size that details have");
  const virtual_topology::limits allowed{
      [&size, share = options.share_of_size](vec3 p) { return share * size(p); }, options.least_angle_deg,
      options.kept_faces};
  auto made = std::make_shared<data>();
  virtual_topology::editable_topology topology(&model_);
  std::size_t found = 1;
  while (found > 0) { // a face that is gone leaves edges that are short now, and the other way round
    found = collapse_short_edges(topology, allowed, made->suppressed);
    found += collapse_tiny_faces(topology, allowed, made->suppressed);
    found += collapse_narrow_faces(topology, allowed, made->suppressed);
    found += collapse_narrow_ends(topology, allowed, made->suppressed);
  }
  made->topology = topology.topology();
  for (std::size_t c = 0; c < topology.curve_count(); ++c)
    made->inner_curve.push_back(topology.inner_curve(static_cast<local_id>(c)));
  for (std::size_t f = 0; f < topology.face_count(); ++f) {
    auto& coedges = made->coedges.emplace_back();
    for (const auto& loop : topology.loops(static_cast<local_id>(f)))
      coedges.insert(coedges.end(), loop.begin(), loop.end());
  }
  made->bend_curves(model_, topology);
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
  for (const auto& end : data_->bent[c]) {
    const auto [share, slope] = end.share_at(given.point);
    const double away = distance(given.point, end.from);
    moved.point += share * end.by;
    if (away > 0)
      moved.derivative += (slope * dot(given.point - end.from, given.derivative) / away) * end.by;
  }
  return moved;
}

DOVETAIL_INLINE vec2 virtual_model::curve_uv(local_id f, int k, double t) const {
  const auto& coedge = data_->coedges[f][k];
  const local_id inner = data_->inner_curve[coedge.curve];
  const auto uv_at = [&](double at) {
    return model_.curve_uv(f, coedge.own, virtual_topology::own_parameter(model_, inner, coedge, at));
  };
  const vec2 uv = uv_at(t);
  vec2 moved = uv;
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
    if (coedge.corners[end]) {
      const double at_end = data_->topology.curves[coedge.curve].t[end];
      const auto& bent = data_->bent[coedge.curve][end];
      const double share = t == at_end ? 1 : bent.share_at(model_.curve_point(inner, t))[0];
      if (share > 0)
        moved = moved + share * (*coedge.corners[end] - uv_at(at_end));
    }
  return moved;
}

DOVETAIL_INLINE double virtual_model::project_to_curve(local_id c, vec3 p, double seed) const {
  const auto& range = data_->topology.curves[c].t;
  return std::clamp(model_.project_to_curve(data_->inner_curve[c], p, seed), range[0], range[1]);
}

DOVETAIL_INLINE report virtual_model::summary() const {
  suppression_counts counts;
  for (const suppressed_detail& one : data_->suppressed) {
    ++(one.what == suppressed_detail::kind::narrow_face  ? counts.narrow_faces
       : one.what == suppressed_detail::kind::narrow_end ? counts.narrow_ends
                                                         : counts.short_edges);
    counts.largest_deviation = std::max(counts.largest_deviation, one.length);
  }
  report made;
  made.name = "virtual topology";
  made.set(counts);
  return made;
}

} // namespace dovetail
