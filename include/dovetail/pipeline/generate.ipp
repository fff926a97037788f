/// @file
/// What `generate.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/pipeline/dimension_steps.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/pipeline/piece_crossings.hpp"
#include "dovetail/pipeline/piece_meshing.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Realizes a decomposition and meshes its subdomains. What no rung of the mesher's ladder can mesh is merged
/// with a neighbour, and what that changes is done again, until nothing fails or nothing more may be merged.
/// So it is, with a smaller size there, where finished pieces cross (D = 2); throws `intersection_error` when
/// that does not help.
template <int D>
std::pair<realized<D>, meshed_pieces<D>>
realize_and_mesh(const any_geometry& model, const simplicial_background<D>& mesh, const side_table<D>& sides,
                 std::span<const side_state> side_states, decomposition pieces,
                 std::span<const double> weights, const any_sizing& size, const any_parameters<D>& given) {
  merge_account account(pieces.parts, given.options.largest_merged_fraction);
  local_id merged_after_failure = 0;
  std::vector<std::string> told;
  piece_crossing_rounds crossing_rounds(size, given.options.refinement_rounds);
  const auto store = std::make_shared<entity_store>(given.options.store);
  skeleton_store skeleton_parts(std::make_shared<entity_store>(given.options.store, "skeleton"));
  for (;;) {
    auto skeleton = realize(model, mesh, sides, side_states, pieces.part_of_element, account,
                            crossing_rounds.size(), crossing_rounds.field(), skeleton_parts, given);
    pieces.part_of_element = skeleton.subdomain_of_element;
    auto meshed = mesh_all_pieces(model, mesh, skeleton, weights, store, given);
    std::vector<local_id> failed;
    for (const piece_failure& failure : meshed.failures)
      failed.push_back(failure.subdomain);
    if (const auto merges = merges_of_failed(skeleton.fine, failed); !merges.empty()) {
      const local_id before = account.merged();
      const std::string refused = account.merge(pieces.part_of_element, merges);
      merged_after_failure += account.merged() - before;
      for (const piece_failure& failure : meshed.failures)
        told.push_back("no attempt could mesh a subdomain, " +
                       (refused.empty() ? "merged with a neighbour" : "and " + refused) + ": " +
                       joined_reasons(failure.reasons));
      if (refused.empty())
        continue;
    } else if (!crossing_rounds.accept(model, skeleton, meshed, given)) {
      continue;
    }
    crossing_rounds.add_to(skeleton.intersection_summary);
    skeleton.intersection_summary.set("merges", account.merged() - merged_after_failure);
    skeleton.intersection_summary.set("largest_merged", account.largest());
    meshed.summary.set("merged_after_failure", merged_after_failure);
    append(meshed.summary.warnings, told);
    return {std::move(skeleton), std::move(meshed)};
  }
}

template <int D>
distributed_simplicial_mesh<D> assemble_mesh(const any_geometry& model, simplicial_skeleton<D> skeleton,
                                             const meshed_pieces<D>& meshed) {
  distributed_simplicial_mesh<D> mesh;
  mesh.skeleton = std::move(skeleton);
  for (const piece_summary& piece : meshed.pieces)
    mesh.counts.push_back(piece.counts);
  mesh.load = meshed.load;
  mesh.release = meshed.release;
  mesh.released = meshed.released;
  for (const auto& solid : model.topology().solids)
    mesh.material_names.push_back(solid.name);
  for (const auto& face : model.topology().faces) {
    mesh.face_names.push_back(face.name);
    mesh.patch_names.push_back(face.patch);
  }
  return mesh;
}

} // namespace detail

template <int D>
generated<D> generate_from_background(const any_geometry& model, background_result<D> background,
                                      const any_parameters<D>& given) {
  const stopwatch clock;
  const generate_options& options = given.options;
  generated<D> result;
  result.summary.name = "generate";
  result.background = std::move(background.mesh);
  result.plan = background.plan;
  const simplicial_background<D>& coarse = result.background;

  options.on_progress("simplification", 0, 0);
  const stopwatch simplification_clock;
  const side_table<D> sides = build_sides(coarse.elements());
  const auto weights = predict_elements<D>(coarse.elements(), background.size).per_element;
  report simplification_summary;
  auto simplified = detail::simplify_background(coarse, sides, weights, result.plan.subdomains,
                                                given.simplify_by, simplification_summary);
  simplification_summary.seconds = simplification_clock.seconds();

  options.on_progress("partition", 0, 0);
  const stopwatch partition_clock;
  auto pieces = decompose<D>(coarse.elements(), sides, simplified.super_of_element, simplified.graph,
                             detail::materials_of(coarse), given.partition_it, result.plan.subdomains);
  result.coarse_angles =
      detail::coarse_interface_angles(coarse, sides, simplified.side_states, pieces.part_of_element, options);
  pieces.summary.seconds = partition_clock.seconds();
  const auto side_states = std::move(simplified.side_states);
  simplified = {}; // its graph is as large as the background mesh

  report partition_summary = pieces.summary;
  auto [skeleton, meshed] = detail::realize_and_mesh<D>(model, coarse, sides, side_states, std::move(pieces),
                                                        weights, background.size, given);
  result.subdomain_of_element = skeleton.subdomain_of_element;
  result.fine_angles = detail::fine_interface_angles(skeleton, coarse, sides, side_states, options);
  result.quality = meshed.quality;
  result.mesh = detail::assemble_mesh<D>(model, std::move(skeleton.fine), meshed);
  result.failures = std::move(meshed.failures);
  result.summary.children = {std::move(background.summary),
                             std::move(simplification_summary),
                             std::move(partition_summary),
                             std::move(skeleton.skeleton_summary),
                             std::move(skeleton.intersection_summary),
                             std::move(meshed.summary)};
  result.summary.seconds = result.summary.children.front().seconds + clock.seconds();
  return result;
}

#ifdef DOVETAIL_COMPILED
template generated<2> generate_from_background<2>(const any_geometry& model, background_result<2> background,
                                                  const any_parameters<2>& given);
template generated<3> generate_from_background<3>(const any_geometry& model, background_result<3> background,
                                                  const any_parameters<3>& given);
#endif

} // namespace dovetail
