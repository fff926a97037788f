/// @file
/// The input and output of the patch remesher: one part of a surface with a planar parameter domain.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/mesh/simplex.hpp"

#include <array>
#include <concepts>
#include <string>
#include <vector>

namespace dovetail {

/// The frozen boundary of a patch: closed loops of segments with the domain on their left in the parameter
/// plane, in any number and order; holes need no cuts. Vertices with equal labels are the same vertex of
/// 3-space: a seam passes it twice with different parameters, a slit twice with equal ones, and a pole is a
/// run of segments whose ends all have the same label.
struct patch_boundary {
  std::vector<vec2> uv;                          ///< by vertex: its parameters
  std::vector<vec3> points;                      ///< by vertex: where it is
  std::vector<local_id> labels;                  ///< by vertex: of which vertex of 3-space it is a passage
  std::vector<std::array<local_id, 2>> segments; ///< the start and the end of each
  /// Pairs of labels that no inner edge may join, because another patch already joins them by an edge that is
  /// not on the boundary.
  std::vector<std::array<local_id, 2>> forbidden_edges = {};

  using fields = field_list<&patch_boundary::uv, &patch_boundary::points, &patch_boundary::labels,
                            &patch_boundary::segments, &patch_boundary::forbidden_edges>;
};

/// About how many triangles there are in a patch: as many as in a disk.
/// \param segments how many are around it
inline double triangles_within(double segments) {
  return segments + segments * segments / 5.4;
}

/// A parametric surface under a patch.
///
/// Valid expressions for `const S& s`, `vec3 p`, `vec2 uv`:
///
/// - `s.frame(uv)`: surface_frame; point and first derivatives
/// - `s.project(p, uv)`: vec2; parameters of the point of the surface nearest p, started from the seed uv
///
/// Semantics: `s.project(s.frame(uv).point, uv)` is uv. Queries are const; they need not be thread-safe.
///
/// Complexity: constant; a projection takes a few Newton steps.
///
/// Failure: throws `geometry_error` naming the face when its kernel cannot evaluate it.
///
/// Models: remesh::plane_surface, triangle_surface, any_surface.
template <class S>
concept patch_surface = requires(const S& s, vec3 p, vec2 uv) {
  { s.frame(uv) } -> std::same_as<surface_frame>;
  { s.project(p, uv) } -> std::same_as<vec2>;
};

/// The mesh of a patch. Vertex ids: the boundary's vertices first, then the inner ones. Where two boundary
/// vertices have both the same label and the same parameters, triangles name the lower index. At a pole they
/// name the boundary vertex whose parameters belong to the corner.
struct patch_mesh {
  std::vector<vec2> inner_uv;
  std::vector<vec3> inner_points;    ///< exactly the surface at `inner_uv`
  std::vector<simplex<2>> triangles; ///< counter-clockwise in the parameter plane
  std::vector<std::array<local_id, 2>>
      crossings;                   ///< segments that cross, touch or overlap; no triangles then
  std::vector<local_id> misplaced; ///< segments with the domain on their wrong side; no triangles then
  /// Triangles whose normal disagrees with the surface's; empty unless the loops or the surface force them.
  std::vector<local_id> folded;
  std::vector<std::array<local_id, 2>> repeated_edges; ///< label pairs joined twice that could not be avoided
  report summary;                                      ///< what was counted on the way

  using fields = field_list<&patch_mesh::inner_uv, &patch_mesh::inner_points, &patch_mesh::triangles,
                            &patch_mesh::crossings, &patch_mesh::misplaced, &patch_mesh::folded,
                            &patch_mesh::repeated_edges, &patch_mesh::summary>;

  /// Whether nothing is wrong with it.
  bool ok() const {
    return crossings.empty() && misplaced.empty() && folded.empty() && repeated_edges.empty();
  }
};

} // namespace dovetail
