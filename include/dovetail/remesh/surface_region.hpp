/// @file
/// What a surface mesher fills: a part of one CAD face, plane or interface between lines that are given.
#pragma once

#include "dovetail/remesh/patch.hpp"
#include "dovetail/remesh/surfaces.hpp"

#include <cstddef>
#include <functional>
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
box3 place_of(const patch_boundary& boundary, const any_surface& surface);

/// Finds the first region of a face.
class region_of_face {
public:
  explicit region_of_face(const std::vector<surface_region>& regions);
  /// Whether there is a region on the face.
  bool has(local_id face) const;
  /// Throws `std::out_of_range` when there is none.
  std::size_t operator()(local_id face) const;

private:
  /// A face may be `no_id`, which comes first.
  static std::size_t place(local_id face) { return static_cast<std::size_t>(face - no_id); }

  std::vector<local_id> first_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/surface_region.ipp"
#endif
