/// @file
/// Where the surface of a model closes around a tube, such as a hole, a wire or a void, and the sizes that
/// tubes need.
#pragma once

#include "dovetail/core/vector.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/sizing/erased.hpp"
#include "dovetail/sizing/size_balls.hpp"
#include "dovetail/sizing/surface_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail::background {

namespace detail {

/// For each curve, the faces at it; a seam has its face twice.
inline std::vector<std::vector<local_id>> faces_at_curves(const geometry_topology& topology) {
  std::vector<std::vector<local_id>> faces(topology.curves.size());
  for (std::size_t f = 0; f < topology.faces.size(); ++f)
    for (const auto& coedge : topology.faces[f].coedges)
      if (!topology.curves[coedge.curve].degenerate)
        faces[coedge.curve].push_back(static_cast<local_id>(f));
  return faces;
}

/// Whether one of the curves has no vertex in common with another.
inline bool some_are_apart(const geometry_topology& topology, const std::vector<local_id>& curves) {
  const auto meet = [&](local_id a, local_id b) {
    const auto& first = topology.curves[a].vertices;
    const auto& second = topology.curves[b].vertices;
    return std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) != first.end();
  };
  return std::any_of(curves.begin(), curves.end(), [&](local_id a) {
    return std::any_of(curves.begin(), curves.end(), [&](local_id b) { return !meet(a, b); });
  });
}

/// Whether a face closes to a ring by itself, along a seam, or with one other face, along two curves that do
/// not meet.
inline bool closes_to_ring(const geometry_topology& topology,
                           const std::vector<std::vector<local_id>>& faces_at, local_id face) {
  std::map<local_id, std::vector<local_id>> shared; // by the face at the other side: curves
  for (const auto& coedge : topology.faces[face].coedges) {
    const auto& both = faces_at[coedge.curve];
    if (std::count(both.begin(), both.end(), face) > 1)
      return true;
    for (const local_id other : both)
      if (other != face)
        shared[other].push_back(coedge.curve);
  }
  return std::any_of(shared.begin(), shared.end(),
                     [&](const auto& entry) { return some_are_apart(topology, entry.second); });
}

} // namespace detail

/// A face that closes to a ring, and where on it the surface goes around a tube about as narrow as its
/// curvature says. An edge as long as such a tube is wide leads through it, so no size that is larger fits;
/// where a surface only bends, as at a fillet, edges may cut the bend off.
template <geometry_model Geometry>
class ring_face {
public:
  /// The model must outlive the object.
  ring_face(const Geometry& model, local_id face) : model_(model), face_(face) { find_range(); }

  /// Whether the surface around a sample of the face is that of a tube.
  bool is_tube_at(const sizing::surface_sample& s) const {
    if (!(lower_.x < upper_.x && lower_.y < upper_.y))
      return false;
    return is_arc(shape_of(along_x(s.uv.y)), s.curvature, longest_along_x_) ||
           is_arc(shape_of(along_y(s.uv.x)), s.curvature, longest_along_y_);
  }

private:
  using parameter_line = std::array<vec2, 2>; ///< straight in the parameter plane

  parameter_line along_x(double y) const { return {{{lower_.x, y}, {upper_.x, y}}}; }
  parameter_line along_y(double x) const { return {{{x, lower_.y}, {x, upper_.y}}}; }

  /// Of a line on the surface.
  struct line_shape {
    double turn = 0; ///< of the normal, in radians
    double length = 0;
  };
  static constexpr int parts = 16; ///< of a curve, and of a line across a face

  void find_range() {
    const auto& coedges = model_.topology().faces[face_].coedges;
    for (std::size_t k = 0; k < coedges.size(); ++k) {
      const auto& t = model_.topology().curves[coedges[k].curve].t;
      for (int i = 0; i <= parts; ++i) {
        const vec2 uv = model_.curve_uv(face_, static_cast<int>(k), t[0] + (t[1] - t[0]) * i / parts);
        lower_ = {std::min(lower_.x, uv.x), std::min(lower_.y, uv.y)};
        upper_ = {std::max(upper_.x, uv.x), std::max(upper_.y, uv.y)};
      }
    }
    constexpr int lines = 5;
    for (int i = 0; i < lines; ++i) {
      const vec2 at = lower_ + (i / (lines - 1.0)) * (upper_ - lower_);
      longest_along_x_ = std::max(longest_along_x_, shape_of(along_x(at.y)).length);
      longest_along_y_ = std::max(longest_along_y_, shape_of(along_y(at.x)).length);
    }
  }

  /// Whether a line across a face turns by half or more, about as evenly as the face is curved at the sample,
  /// and not at a tip of the face: the nose of a wing is far more curved than a section of it is on average.
  static bool is_arc(const line_shape& line, double curvature, double longest) {
    constexpr double least_turn = 2.8; // radians
    constexpr double most_uneven = 1.5, share_at_tips = 0.25;
    return line.turn >= least_turn && curvature * line.length <= most_uneven * line.turn &&
           line.length >= share_at_tips * longest;
  }
  line_shape shape_of(const parameter_line& line) const {
    line_shape shape;
    surface_frame before = model_.face_frame(face_, line[0]);
    for (int i = 1; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const surface_frame next = model_.face_frame(face_, line[0] + share * (line[1] - line[0]));
      shape.turn += std::acos(std::clamp(dot(normal_of(before), normal_of(next)), -1.0, 1.0));
      shape.length += distance(before.point, next.point);
      before = next;
    }
    return shape;
  }

  static vec3 normal_of(const surface_frame& frame) { return normalized(cross(frame.du, frame.dv)); }

  const Geometry& model_;
  local_id face_;
  vec2 lower_{1e300, 1e300}; ///< of its parameters
  vec2 upper_{-1e300, -1e300};
  double longest_along_x_ = 0; ///< on the surface, of lines across these parameters
  double longest_along_y_ = 0;
};

/// The sizes at tubes far narrower than a field says: there edges turn by 60 degrees, about six of them
/// around. Empty where a model has none. A mesher that is asked for larger triangles on such a face makes
/// needles along it, and no good elements fit those.
/// Linear in the samples of faces that close to rings; throws what the model's queries and the field throw.
/// \param model the model
/// \param size edge lengths wanted, in the model's unit
template <geometry_model Geometry, sizing_field Size>
std::vector<size_ball> sizes_at_tubes(const Geometry& model, const Size& size) {
  constexpr double turn = std::numbers::pi / 3; // of an edge, in radians
  constexpr double narrow = 4;                  // radii of a tube that are less than the size
  constexpr double sizes_apart = 1.5;
  constexpr sizing::sampling_limits limits{
      .per_face = 8000, .least_halvings = 3, .most_halvings = 13, .halvings_of_curves = 10};
  std::vector<size_ball> balls;
  const auto faces_at = detail::faces_at_curves(model.topology());
  for (std::size_t f = 0; f < model.topology().faces.size(); ++f) {
    const auto face = static_cast<local_id>(f);
    if (!detail::closes_to_ring(model.topology(), faces_at, face))
      continue;
    std::optional<ring_face<Geometry>> ring; // made where it is wanted: on most faces sizes fit everywhere
    const auto spacing = [&](const sizing::surface_sample& s) {
      constexpr double any = std::numeric_limits<double>::infinity();
      if (s.curvature * size(s.point) <= narrow)
        return any;
      if (!ring)
        ring.emplace(model, face);
      return ring->is_tube_at(s) ? sizes_apart * turn / s.curvature : any;
    };
    for (const auto& s : sizing::surface_sampler(model, spacing, limits).run(face))
      if (s.spacing < std::numeric_limits<double>::infinity())
        balls.push_back({s.point, 0, s.spacing / sizes_apart});
  }
  return balls;
}

/// A field that is no larger than at tubes either, and grows away from them.
/// Complexity: n log n in these. Throws nothing.
/// \param size edge lengths wanted, in the model's unit
/// \param at_tubes as `sizes_at_tubes` has them
inline any_sizing finer_at_tubes(const any_sizing& size, std::vector<size_ball> at_tubes) {
  constexpr double growth = 0.3;
  return at_tubes.empty() ? size : within_bounds(size, std::move(at_tubes), growth);
}

} // namespace dovetail::background
