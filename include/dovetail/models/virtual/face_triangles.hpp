/// @file
/// Triangles of a face between points of its boundary and its surface.
#pragma once

#include "dovetail/models/virtual/composite_chart.hpp"
#include "dovetail/models/virtual/editable_topology.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace dovetail::virtual_topology {

/// Where a passage is in the parameter plane of the model's face, at a parameter of the curve.
using uv_of_passage = std::function<vec2(const virtual_coedge&, double)>;

/// Triangulates faces, each once. Both faces at a curve have the same points of it.
class face_triangles {
public:
  /// \param topology with the faces, of which the triangles are
  /// \param uv where their boundaries are in their parameter planes
  /// \param sag how far triangles may be from the surface, by place; boundaries a fifth of that
  face_triangles(editable_topology topology, uv_of_passage uv, any_sizing sag)
      : topology_(std::move(topology)), uv_(std::move(uv)), sag_(std::move(sag)) {}

  /// Counter-clockwise in the parameter plane, with little turn of the surface in each. Nothing of a face
  /// with a seam or a pole, or whose boundary crosses itself, or that takes very many. Some thousand queries
  /// of the model the first time.
  const std::optional<std::vector<charted_triangle>>& of_face(local_id f);

  /// The parameters of the points of a curve, growing; nothing where these would be very many.
  const std::optional<std::vector<double>>& of_curve(local_id c);

  /// The point of a passage on its face.
  vec3 point(const virtual_coedge& coedge, double t) const {
    return topology_.model().face_point(coedge.own_face, uv_(coedge, t));
  }
  /// The parametric normal of the face there, as long as the model has it.
  vec3 normal(const virtual_coedge& coedge, double t) const;

private:
  /// A point of a curve as a passage has it.
  struct place {
    vec2 uv;
    vec3 point, normal; ///< of the face, the normal as long as the model has it
  };
  /// The same as all passages along the curve have it.
  struct curve_sample {
    double t = 0;
    std::vector<place> places;
  };

  std::optional<std::vector<double>> sampled(local_id c) const;
  curve_sample sample_at(const std::vector<passage>& passages, double t) const;
  bool is_straight(const std::vector<passage>& passages, const curve_sample& from, const curve_sample& middle,
                   const curve_sample& to) const;
  std::optional<std::vector<charted_triangle>> triangulated(local_id f);

  editable_topology topology_;
  uv_of_passage uv_;
  any_sizing sag_;
  std::map<local_id, std::optional<std::vector<charted_triangle>>> faces_;
  std::map<local_id, std::optional<std::vector<double>>> curves_;
};

} // namespace dovetail::virtual_topology

#ifndef DOVETAIL_COMPILED
#include "dovetail/models/virtual/face_triangles.ipp"
#endif
