/// @file
/// What a surface mesher fills: a part of one CAD face, plane or interface between lines that are given.
#pragma once

#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/surfaces.hpp"
#include "dovetail/sizing/refined_sizing.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

namespace dovetail {

/// A region of a surface, of a skeleton or of a piece, whose boundary points are the labels of its boundary.
struct surface_region {
  patch_boundary boundary; ///< what bounds it
  any_surface surface;     ///< what it is on
  local_id face = no_id;   ///< the CAD face; the tag of the region's elements
  bool reversed = false;   ///< elements are oriented against the parameter plane
  /// Whether no inner edge may join two labels, since another region might do so or a line does; may be
  /// empty.
  std::function<bool(local_id, local_id)> forbids = {};
  double size_factor = 1; ///< of the sizes inside: below 1 for a region that was folded over
};

/// The box that a region lies in, about: around its boundary and a grid of points of the surface between,
/// since a surface may bulge far out of its boundary; with room for what is between these.
inline box3 place_of(const patch_boundary& boundary, const any_surface& surface) {
  constexpr int steps = 6;
  std::vector<vec3> points = boundary.points;
  vec2 lower = boundary.uv.front(), upper = lower;
  for (const vec2 uv : boundary.uv) {
    lower = {std::min(lower.x, uv.x), std::min(lower.y, uv.y)};
    upper = {std::max(upper.x, uv.x), std::max(upper.y, uv.y)};
  }
  const vec2 step = (1.0 / steps) * (upper - lower);
  for (int i = 1; i < steps; ++i)
    for (int j = 1; j < steps; ++j)
      points.push_back(surface.frame({lower.x + i * step.x, lower.y + j * step.y}).point);
  return roomy_box_around(points);
}

/// Finds the first region of a face.
class region_of_face {
public:
  explicit region_of_face(const std::vector<surface_region>& regions) {
    for (std::size_t r = regions.size(); r-- > 0;) {
      const std::size_t face = place(regions[r].face);
      first_.resize(std::max(first_.size(), face + 1), no_id);
      first_[face] = static_cast<local_id>(r);
    }
  }
  /// Whether there is a region on the face.
  bool has(local_id face) const {
    return face >= no_id && place(face) < first_.size() && first_[place(face)] != no_id;
  }
  /// Throws `std::out_of_range` when there is none.
  std::size_t operator()(local_id face) const {
    const local_id r = first_.at(place(face));
    return r == no_id ? throw std::out_of_range("no region of this face") : static_cast<std::size_t>(r);
  }

private:
  /// A face may be `no_id`, which comes first.
  static std::size_t place(local_id face) { return static_cast<std::size_t>(face - no_id); }

  std::vector<local_id> first_;
};

} // namespace dovetail
