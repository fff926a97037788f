/// @file
/// What `virtual_model.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/models/virtual/editable_topology.hpp"
#include "dovetail/models/virtual/narrow_faces.hpp"
#include "dovetail/models/virtual/short_edges.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "dovetail/sizing/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dovetail {

struct virtual_model::data {
  geometry_topology topology;
  std::vector<local_id> inner_curve;                                  ///< by curve
  std::vector<std::vector<virtual_topology::virtual_coedge>> coedges; ///< by face
  std::vector<suppressed_detail> suppressed;
};

DOVETAIL_INLINE virtual_model::virtual_model(any_geometry model, const any_sizing& size,
                                             const virtual_options& options)
    : model_(std::move(model)) {
  sizing::checked_length(options.share_of_size, "the share of the size that details have");
  const virtual_topology::limits allowed{
      [&size, share = options.share_of_size](vec3 p) { return share * size(p); }, options.least_angle_deg};
  auto made = std::make_shared<data>();
  virtual_topology::editable_topology topology(&model_);
  std::size_t found = 1;
  while (found > 0) { // a face that is gone leaves edges that are short now, and the other way round
    found = collapse_short_edges(topology, allowed, made->suppressed);
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
  data_ = std::move(made);
}

DOVETAIL_INLINE const geometry_topology& virtual_model::topology() const {
  return data_->topology;
}

DOVETAIL_INLINE const std::vector<suppressed_detail>& virtual_model::suppressed() const {
  return data_->suppressed;
}

DOVETAIL_INLINE vec3 virtual_model::curve_point(local_id c, double t) const {
  return model_.curve_point(data_->inner_curve[c], t);
}

DOVETAIL_INLINE curve_frame virtual_model::curve_frame(local_id c, double t) const {
  return model_.curve_frame(data_->inner_curve[c], t);
}

DOVETAIL_INLINE vec2 virtual_model::curve_uv(local_id f, int k, double t) const {
  const auto& coedge = data_->coedges[f][k];
  const auto& range = data_->topology.curves[coedge.curve].t;
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
    if (t == range[end] && coedge.corners[end])
      return *coedge.corners[end];
  return model_.curve_uv(
      f, coedge.own, virtual_topology::own_parameter(model_, data_->inner_curve[coedge.curve], coedge, t));
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
