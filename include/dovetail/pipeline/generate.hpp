/// @file
/// The whole pipeline, for D = 2 and D = 3: from a CAD model and a sizing field to a distributed mesh (paper,
/// figures 3 and 8). What the dimensions do not share is in `dimension_steps.hpp`.
#pragma once

#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"
#include "dovetail/pipeline/dimension_steps.hpp"
#include "dovetail/pipeline/piece_crossings.hpp"
#include "dovetail/pipeline/piece_meshing.hpp"

#include <utility>

namespace dovetail {

/// A generated mesh and all that is known about it. Subdomains that could not be meshed are in `failures`;
/// `mesh` is whole only when there are none.
template <int D>
struct generated {
  distributed_simplicial_mesh<D> mesh;
  simplicial_background<D> background;
  std::vector<local_id> subdomain_of_element; ///< of the background mesh
  mesh_plan plan;
  interface_contract coarse_contract; ///< of the coarse skeleton, before merges
  interface_contract fine_contract;
  quality_statistics quality;
  std::vector<piece_failure> failures;
  report summary; ///< children: background, simplification, partition, skeleton, intersection, meshing
};

using generate_result = generated<3>;

namespace detail {

/// Realizes a decomposition and meshes its subdomains. What no rung of the mesher's ladder can mesh is merged
/// with a neighbour and all is done again, until nothing fails or nothing can be merged. So it is, with a
/// smaller size there, where finished pieces cross (D = 2); throws `intersection_error` when that does not
/// help.
template <int D>
std::pair<realized<D>, meshed_pieces<D>>
realize_and_mesh(const any_geometry& model, const simplicial_background<D>& mesh, const side_table<D>& sides,
                 std::span<const side_state> side_states, decomposition pieces,
                 std::span<const double> weights, const any_sizing& size, const any_parameters<D>& given) {
  std::vector<local_id> sizes(static_cast<std::size_t>(pieces.parts), 1);
  piece_crossing_rounds crossing_rounds(size, given.options.refinement_rounds);
  for (int attempt = 0;; ++attempt) {
    auto skeleton = realize(model, mesh, sides, side_states, pieces.part_of_element,
                            static_cast<local_id>(sizes.size()), crossing_rounds.size(), given);
    auto meshed = mesh_all_pieces(model, mesh, skeleton, weights, attempt, given);
    std::vector<local_id> failed;
    for (const piece_failure& failure : meshed.failures)
      failed.push_back(failure.subdomain);
    const auto merges = merges_of_failed(skeleton.fine, failed);
    meshed.summary.set("merged_after_failure",
                       static_cast<double>(pieces.parts) - static_cast<double>(sizes.size()));
    if (merges.empty()) {
      if (!crossing_rounds.accept(model, skeleton, meshed, given))
        continue;
      crossing_rounds.add_to(skeleton.intersection_summary);
      return {std::move(skeleton), std::move(meshed)};
    }
    pieces.part_of_element = skeleton.subdomain_of_element;
    sizes.assign(skeleton.material_of_subdomain.size(), 1);
    merge_subdomains(pieces.part_of_element, sizes, merges);
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
  for (const auto& solid : model.topology().solids)
    mesh.material_names.push_back(solid.name);
  for (const auto& face : model.topology().faces) {
    mesh.face_names.push_back(face.name);
    mesh.patch_names.push_back(face.patch);
  }
  return mesh;
}

} // namespace detail

/// What `generate` does once the background mesh is there: `background` must be what `make_background` makes
/// for the same model, field, mesher and options but `simplify`. For runs that differ in the partitioner or
/// the improver alone.
template <int D>
  requires(D == 2 || D == 3)
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
  const auto simplified = detail::simplify_background(coarse, sides, weights, result.plan.subdomains, options,
                                                      simplification_summary);
  simplification_summary.seconds = simplification_clock.seconds();

  options.on_progress("partition", 0, 0);
  const stopwatch partition_clock;
  auto pieces = decompose<D>(coarse.elements(), sides, simplified.super_of_element, simplified.graph,
                             detail::materials_of(coarse), given.partition_it, result.plan.subdomains);
  result.coarse_contract = detail::coarse_interface_contract(coarse, sides, simplified.side_states,
                                                             pieces.part_of_element, options);
  pieces.summary.seconds = partition_clock.seconds();

  report partition_summary = pieces.summary;
  auto [skeleton, meshed] = detail::realize_and_mesh<D>(model, coarse, sides, simplified.side_states,
                                                        std::move(pieces), weights, background.size, given);
  result.subdomain_of_element = skeleton.subdomain_of_element;
  result.fine_contract =
      detail::fine_interface_contract(skeleton, coarse, sides, simplified.side_states, options);
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

/// Generates a mesh sized by `size`: for D = 3 tetrahedra of all solids of `model`, for D = 2 triangles of
/// all its faces.
///
///     auto solid = generate<3>(model, uniform_size(2.0), parameters<>{}.with_mesher(mesher::tetgen{}));
///     auto shell = generate<2>(model, uniform_size(2.0), parameters<>{});
///
/// The mesh depends on the model, the field and the parameters, not on the executor or its workers. Throws
/// what the stages throw: typed errors that name the CAD entity concerned. A subdomain that no attempt could
/// mesh is data.
template <int D, geometry_model G, sizing_field H, class Parameters>
  requires(D == 2 || D == 3)
generated<D> generate(const G& given_model, const H& given_size, const Parameters& policies) {
  const any_geometry model(given_model);
  const erased_sizing size(given_size);
  const any_parameters<D> given(policies);
  return generate_from_background<D>(model, make_background<D>(model, size, given), given);
}

} // namespace dovetail
