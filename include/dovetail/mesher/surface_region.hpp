/// @file
/// What a mesher of D = 2 fills: a connected part of one CAD face or plane between lines that are given.
#pragma once

#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/surfaces.hpp"

#include <functional>
#include <optional>

namespace dovetail {

/// A parametric surface chosen at run time; a model of `patch_surface`.
struct any_surface {
  std::function<surface_frame(vec2)> frame;
  std::function<vec2(vec3, vec2)> project;
  /// The same surface where it is a plane with orthonormal parameters: meshers then need no calls.
  std::optional<remesh::plane_surface> plane = std::nullopt;
};

/// A region of a piece. The labels of its boundary are points of the piece's boundary.
struct surface_region {
  patch_boundary boundary;
  any_surface surface;
  local_id face = no_id; ///< the CAD face; the tag of the region's elements
  bool reversed = false; ///< elements are oriented against the parameter plane
  /// Whether no inner edge may join two labels, since another region might do so or a line does; may be
  /// empty.
  std::function<bool(local_id, local_id)> forbids = {};
};

} // namespace dovetail
