/// @file
/// From a decomposed background mesh to the fine boundaries of its subdomains: skeleton, remeshing, and
/// crossings suppressed by merging, to a fixpoint (paper, sections 3.5 and 3.6).
#pragma once

#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/pipeline/any_parameters.hpp"
#include "dovetail/skeleton/line_skeleton.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"

#include <span>
#include <vector>

namespace dovetail {

/// What only one dimension asks of a realized decomposition.
template <int D>
struct realized_details;

template <>
struct realized_details<3> {
  std::vector<triangle_origin> origins; ///< per fine triangle, for the interface angles
};

/// The boundaries are the lines; the regions between them are meshed as pieces.
template <>
struct realized_details<2> {
  numbered_lines lines;
  std::vector<std::vector<local_id>> regions; ///< of each subdomain, in `coarse`
};

/// A decomposition after merges, with the fine boundaries of its pieces.
template <int D>
struct realized : realized_details<D> {
  simplicial_skeleton<D> fine;
  coarse_skeleton coarse;
  std::vector<local_id> subdomain_of_element;  ///< of the background mesh, after merges
  std::vector<local_id> material_of_subdomain; ///< after merges; all 0 in D = 2
  any_sizing size;                             ///< the field given, smaller where CAD regions came too close
  content_key field;                           ///< of `size`
  report skeleton_summary;
  /// "crossings", "rounds", "refinements"; in D = 2 of the finished pieces, since lines of one region that
  /// cross fail as its piece.
  report intersection_summary;
};

using realized_skeleton = realized<3>;

/// Remeshes the lines of a decomposed surface, each once: what D = 3 does with the pieces that its subdomains
/// induce on the surface, before it fills the regions between the lines. Throws what the geometry throws.
realized<2> realize(const any_geometry& model, const simplicial_background<2>& mesh,
                    const side_table<2>& sides, std::span<const side_state>,
                    std::vector<local_id> subdomain_of_element, merge_account& merges, const any_sizing& size,
                    content_key field, skeleton_store& made, const any_parameters<2>& given);

/// Remeshes the skeleton of a decomposition until nothing crosses. `side_states` are what the simplification
/// decided about the sides of the coarse volume, `merges` what was merged before in this run. Throws
/// `intersection_error` when too many subdomains would have to be merged in all or two CAD faces cross,
/// `mesher_error` when a region cannot be remeshed. `field` is the key of `size`; `made` carries lines and
/// patches from one call to the next, as in `remesh_skeleton`.
realized_skeleton realize(const any_geometry& model, const background_mesh& mesh, const side_table<3>& sides,
                          std::span<const side_state> side_states, std::vector<local_id> subdomain_of_element,
                          merge_account& merges, const any_sizing& size, content_key field,
                          skeleton_store& made, const any_parameters<3>& given);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/realize.ipp"
#endif
