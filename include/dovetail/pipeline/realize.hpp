/// @file
/// From a decomposed background mesh to the fine boundaries of its pieces: the skeleton, its lines, and in
/// D = 3 the patches between them (paper, sections 3.4 and 3.5).
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/pipeline/bound_parameters.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/skeleton/fine_lines.hpp"
#include "dovetail/skeleton/line_segments.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"

#include <utility>
#include <vector>

namespace dovetail {

/// What is counted of a skeleton. What a dimension does not have is 0, and seconds and what was made add up
/// over the tries at one skeleton.
struct skeleton_counts {
  std::size_t lines = 0;           ///< between patches
  std::size_t regions = 0;         ///< of CAD faces
  std::size_t interface_faces = 0; ///< coarse ones
  std::size_t triangles = 0;       ///< of D = 3
  std::size_t edges = 0;           ///< of D = 2
  std::size_t points = 0;          ///< of the fine skeleton
  std::size_t lines_made = 0;      ///< the others were made before
  std::size_t patches_made = 0;    ///< likewise
  double line_seconds = 0;         ///< for lines
  double matching_seconds = 0;     ///< for numbers of segments
  std::size_t matched_lines = 0;   ///< whose numbers of segments were changed for the angles of patches
  int repartition_rounds = 0;      ///< of local repartition
  std::size_t repartitioned = 0;   ///< super-elements that changed their subdomain
  double repartition_seconds = 0;  ///< for local repartition

  using fields =
      field_list<&skeleton_counts::lines, &skeleton_counts::regions, &skeleton_counts::interface_faces,
                 &skeleton_counts::triangles, &skeleton_counts::edges, &skeleton_counts::points,
                 &skeleton_counts::lines_made, &skeleton_counts::patches_made, &skeleton_counts::line_seconds,
                 &skeleton_counts::matching_seconds, &skeleton_counts::matched_lines,
                 &skeleton_counts::repartition_rounds, &skeleton_counts::repartitioned,
                 &skeleton_counts::repartition_seconds>;
};

/// A decomposition with the fine boundaries of its pieces.
template <int D>
struct realized {
  std::vector<local_id> subdomain_of_element;  ///< of the background mesh
  std::vector<local_id> material_of_subdomain; ///< all 0 in D = 2
  coarse_skeleton coarse;                      ///< what is between its subdomains, in coarse entities
  simplicial_skeleton<D> fine;                 ///< the same, remeshed
  numbered_lines lines;     ///< in D = 2; in D = 3 they are given up when the patches are made
  remeshed_patches patches; ///< in D = 3; in D = 2 what lies between the lines are the pieces
  skeleton_counts counts;   ///< what was counted on the way
  report summary;           ///< the same, with warnings and deviations
  bool is_part = false;     ///< only of the skeleton around some points (`realize_part`)
};

/// The lines, patches and matching segments made so far. After a merge of subdomains most are as before.
struct skeleton_memo {
  /// In memory, as long as this.
  skeleton_memo() = default;
  /// Where an executor keeps its results.
  explicit skeleton_memo(const any_executor& run)
      : lines(run, "skeleton"), patches{{run, "skeleton"}}, segments(run, "skeleton") {}

  memo<fine_line> lines;                       ///< of lines
  region_memo patches;                         ///< of regions and interface faces
  matched_faces segments;                      ///< of lines, for groups of interface faces
  std::vector<kept<patch_mesh>> patches_apart; ///< growing; of a skeleton of which no two triangles cross
};

/// Finds the skeleton of a divided background mesh, of which some parts may have been merged since, into
/// `subdomains` and remeshes what bounds its pieces, each line and patch once. D = 3 does with the pieces
/// that its subdomains induce on the surface what D = 2 does with its own, and adds interface faces. `made`
/// carries lines and patches from one call to the next. Patches that fail are in the result; throws
/// `mesher_error` when a line or patch cannot be evaluated at all.
/// About linear in the triangles of the skeleton.
/// \param model the model that the mesh is of
/// \param mesh the background mesh
/// \param divided how it was divided
/// \param subdomain_of_element per element its subdomain, after merges
/// \param subdomains how many there are after merges
/// \param size edge lengths wanted, in the units of the model
/// \param made lines and patches of earlier rounds; grows
/// \param given policies and options
template <int D, bound_parameters<D> Parameters>
realized<D> realize(const any_geometry& model, const simplicial_background<D>& mesh,
                    const divided_background<D>& divided, std::vector<local_id> subdomain_of_element,
                    std::size_t subdomains, const refined_sizing& size, skeleton_memo& made,
                    const Parameters& given);
template <int D, class Parameters>
realized<D> realize(const any_geometry& model, const simplicial_background<D>& mesh,
                    const divided_background<D>& divided, std::vector<local_id> subdomain_of_element,
                    std::size_t subdomains, const refined_sizing& size, skeleton_memo& made,
                    const Parameters& given) {
  return realize<D>(model, mesh, divided, std::move(subdomain_of_element), subdomains, size, made,
                    bind_parameters<D>(given));
}

/// The same of what has one of some points of the background mesh in D = 3: all patches there, and their
/// lines. At these points it is nearly what `realize` makes: patches farther off may change the numbers of
/// segments of lines. A curve is as long as its lines that are there. Costs what
/// there is there, and a walk over the background mesh.
/// \param is_wanted per point of the background mesh
template <bound_parameters<3> Parameters>
realized<3> realize_part(const any_geometry& model, const simplicial_background<3>& mesh,
                         const divided_background<3>& divided, std::vector<local_id> subdomain_of_element,
                         std::size_t subdomains, const refined_sizing& size, skeleton_memo& made,
                         const Parameters& given, const std::vector<bool>& is_wanted);

/// `realize` of what bounds the subdomains `given.options.only`, numbered as in `subdomain_of_element`, with
/// what may cross it, and as far on from there as it takes: until one more ring of elements changes nothing
/// of what bounds them. Numbers of segments are chosen one face after the other, so this is no proof that
/// they are as in the whole; it was so in each case tried (docs/benchmarks.md). Costs what there is there,
/// once more for each ring, and some walks over the background mesh.
template <bound_parameters<3> Parameters>
realized<3> realize_around(const any_geometry& model, const simplicial_background<3>& mesh,
                           const divided_background<3>& divided, std::vector<local_id> subdomain_of_element,
                           std::size_t subdomains, const refined_sizing& size, skeleton_memo& made,
                           const Parameters& given);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/realize.ipp"
#endif
