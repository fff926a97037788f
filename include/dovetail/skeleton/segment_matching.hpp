/// @file
/// Numbers of segments that suit each other. Lines of nearly the same length whose numbers of segments come
/// out differently by rounding leave an interface face with a small angle at a corner that no triangulation
/// of the face can mend; other numbers of segments for its lines can.
#pragma once

#include "dovetail/mesh/coarse_skeleton.hpp"
#include "dovetail/skeleton/fine_lines.hpp"
#include "dovetail/skeleton/line_segments.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"

#include <cstddef>
#include <span>

namespace dovetail {

/// Gives lines other numbers of segments, or uneven ones (`skeleton_line::segments`, `bias`), where that
/// lifts the smallest angle of an interface face towards `threshold_deg` and costs the faces beside it less.
/// `faces` are those with smaller angles on the present `lines` (`faces_with_small_angles`). They are tried
/// with `mesher`, in their order, and side by side through `run` where they do not touch: the
/// result is a function of the skeleton, the model, the sizes and the mesher. `made` carries what was found
/// for a face from one call to the next. Returns the number of lines with such segments. Costs up to some
/// hundred meshes of each face with a smaller angle, fewer where its corners tell that they cannot help.
/// Throws `mesher_error` when a trial cannot be evaluated.
std::size_t match_segments(const any_geometry& model, std::span<const vec3> coarse_points,
                           coarse_skeleton& skeleton, std::vector<fine_line> lines,
                           std::vector<local_id> faces, const refined_sizing& size, double threshold_deg,
                           const any_surface_mesher& mesher, const any_executor& run,
                           batched_entities<face_segments>& made, const progress& on_progress = {});

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/skeleton/segment_matching.ipp"
#endif
