/// @file
/// Which side of an oriented boundary each element lies on: the robust alternative to hole and region points.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// Labels every element of `mesh`. `triangles` are oriented outwards of the elements that carry
/// `labels[triangle]` (all 0 when `labels` is empty); an interface between two labels is listed in both
/// directions. Elements in front of a triangle that is listed in one direction only get no_id: they are
/// outside. About linear time. Throws `mesher_error` when the boundary contradicts itself.
std::vector<local_id> label_elements(const simplicial_mesh<3>& mesh, std::span<const simplex<2>> triangles,
                                     std::span<const local_id> labels = {});

/// Removes the elements labelled no_id, and the points from `kept_points` on that no element uses any more.
void drop_outside(simplicial_mesh<3>& mesh, std::span<const local_id> labels, std::size_t kept_points);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesher/element_labels.ipp"
#endif
