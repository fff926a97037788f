/// @file
/// Where the middle of a mesh edge on a curve or a face of a model lies.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail {

/// Finds middles of edges: the point of the curve or face nearest the middle of the straight edge. A pure
/// function of the edge's two points, in any order, and the entity. Samples each entity once, 65 points of a
/// curve and 625 of a face, as seeds of projections. Not to be shared by threads; copies are cheap before the
/// first call.
class edge_middles {
public:
  explicit edge_middles(any_geometry model) : model_(std::move(model)) {}

  /// Nothing when the model finds no such point within half the edge's length. Exactly the straight middle
  /// on planes, inside solids, and where the entity is as near to it as rounding tells. About 1000 distances
  /// and a few evaluations of the model.
  std::optional<vec3> operator()(vec3 a, vec3 b, host on);

private:
  static constexpr double longest_way = 0.5;
  static constexpr double rounding = 1e-12;
  static constexpr int curve_samples = 65;
  static constexpr int face_samples = 25; ///< along each parameter
  static constexpr std::size_t tried = 4;

  struct sample {
    vec2 at; ///< of a curve: (t, 0)
    vec3 point;
  };

  std::optional<vec3> projected(vec3 p, host on, vec2 seed) const;

  /// The nearest first.
  std::vector<sample> nearest_samples(vec3 p, host on);

  std::vector<sample> of_curve(local_id c) const;

  /// On a grid over the parameters of the face's boundary.
  std::vector<sample> of_face(local_id f) const;

  any_geometry model_;
  std::map<host, std::vector<sample>> samples_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/edge_middles.ipp"
#endif
