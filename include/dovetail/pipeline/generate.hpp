/// @file
/// The whole pipeline: from a CAD model and a sizing field to a distributed mesh (paper, figures 3 and 8).
#pragma once

#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/subdomain_boundary.hpp"
#include "dovetail/mesher/mesh_subdomains.hpp"
#include "dovetail/pipeline/realize.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"
#include "dovetail/sizing/prediction.hpp"
#include "dovetail/skeleton/subdomain_surface.hpp"

namespace dovetail {

/// A generated mesh and all that is known about it. Subdomains that could not be meshed are in `failures`;
/// `mesh` is whole only when there are none.
struct generate_result {
  distributed_mesh mesh;
  background_mesh background;
  std::vector<local_id> subdomain_of_element; ///< of the background mesh
  mesh_plan plan;
  interface_contract coarse_contract; ///< of the coarse skeleton, before merges
  interface_contract fine_contract;
  quality_statistics quality;
  std::vector<piece_failure> failures;
  report summary; ///< children: background, simplification, partition, skeleton, intersection, meshing
};

namespace detail {

/// What each coarse side is when nothing is simplified: every element is a super-element.
inline simplification<3> without_simplification(const background_mesh& mesh, const side_table<3>& sides,
                                                std::span<const double> weights) {
  simplify_parameters<3> nothing;
  nothing.wedge_threshold_deg = 0;
  nothing.shape_threshold_deg = 0;
  return simplify<3>(mesh.volume, sides, {.element_weights = weights}, nothing);
}

inline simplification<3> simplify_background(const background_mesh& mesh, const side_table<3>& sides,
                                             std::span<const double> weights, int subdomains,
                                             const generate_options& options, report& summary) {
  if (!options.simplify) {
    auto plain = without_simplification(mesh, sides, weights);
    summary = plain.summary;
    summary.name = "simplification";
    return plain;
  }
  std::vector<simplex<1>> curve_edges;
  for (const auto& edge : mesh.surface.curve_edges)
    curve_edges.push_back(edge.vertices);
  simplify_parameters<2> on_surface;
  on_surface.wedge_threshold_deg = options.surface_angle_deg;
  on_surface.subdomains = subdomains;
  simplify_parameters<3> in_volume;
  in_volume.wedge_threshold_deg = in_volume.shape_threshold_deg = options.interface_angle_deg;
  in_volume.subdomains = subdomains;
  auto coupled =
      simplify_coupled(mesh.surface.mesh, mesh.volume, sides,
                       {.curve_edges = curve_edges, .element_weights = weights}, on_surface, in_volume);
  summary = std::move(coupled.summary);
  return std::move(coupled.volume);
}

inline interface_contract coarse_interface_contract(const background_mesh& mesh, const side_table<3>& sides,
                                                    std::span<const side_state> side_states,
                                                    std::span<const local_id> subdomain_of_element,
                                                    double threshold_deg) {
  const auto boundary = subdomain_boundary<3>(mesh.volume, sides, subdomain_of_element);
  const auto origins = triangle_origins(boundary, side_states);
  return check_interface_contract({mesh.volume.points, boundary.sides, boundary.subdomains, origins},
                                  threshold_deg);
}

/// Predicted elements of each subdomain, the cost that decides which is meshed first.
inline std::vector<double> weights_of_subdomains(const realized_skeleton& skeleton,
                                                 std::span<const double> weights) {
  std::vector<double> sums(skeleton.material_of_subdomain.size(), 0);
  for (std::size_t e = 0; e < weights.size(); ++e)
    sums[static_cast<std::size_t>(skeleton.subdomain_of_element[e])] += weights[e];
  return sums;
}

template <class Parameters>
meshing_result mesh_all_subdomains(const realized_skeleton& skeleton, std::vector<double> costs, int attempt,
                                   const Parameters& given) {
  const std::size_t count = skeleton.material_of_subdomain.size();
  const auto sorted = sort_by_subdomain(skeleton.fine, count);
  const subdomain_source source = [&](local_id s) {
    auto surface = surface_of_subdomain(skeleton.fine, sorted, s);
    subdomain_input input;
    input.boundary = {std::move(surface.boundary),
                      skeleton.material_of_subdomain[static_cast<std::size_t>(s)]};
    input.skeleton_points = std::move(surface.skeleton_points);
    return input;
  };
  meshing_options options;
  options.predicted_cost = std::move(costs);
  options.store = given.options.store;
  options.store_prefix = attempt == 0 ? "" : "merged_" + std::to_string(attempt) + "_";
  options.failure_folder = given.options.failure_folder;
  options.limit_seconds = given.options.limit_seconds;
  options.on_progress = given.options.on_progress;
  return mesh_subdomains(count, source, given.mesh_it, given.improve_it, skeleton.size, given.run_tasks,
                         options);
}

/// A skeleton and the mesh inside it.
struct meshed_skeleton {
  realized_skeleton skeleton;
  meshing_result meshed;
};

/// Realizes a decomposition and meshes its subdomains. What no rung of the mesher's ladder can mesh is merged
/// with a neighbour and all is done again, until nothing fails or nothing can be merged.
template <geometry_model G, class Parameters>
meshed_skeleton realize_and_mesh(const G& model, const background_mesh& mesh, const side_table<3>& sides,
                                 std::span<const side_state> side_states, decomposition pieces,
                                 std::span<const double> weights, const any_sizing& size,
                                 const Parameters& given) {
  std::vector<local_id> sizes(static_cast<std::size_t>(pieces.parts), 1);
  for (int attempt = 0;; ++attempt) {
    meshed_skeleton result;
    result.skeleton = realize(model, mesh, sides, side_states, pieces.part_of_element,
                              static_cast<local_id>(sizes.size()), size, given);
    result.meshed =
        mesh_all_subdomains(result.skeleton, weights_of_subdomains(result.skeleton, weights), attempt, given);
    std::vector<local_id> failed;
    for (const piece_failure& failure : result.meshed.failures)
      failed.push_back(failure.subdomain);
    const auto merges = merges_of_failed(result.skeleton.fine, failed);
    result.meshed.summary.set("merged_after_failure",
                              static_cast<double>(pieces.parts) - static_cast<double>(sizes.size()));
    if (merges.empty())
      return result;
    pieces.part_of_element = result.skeleton.subdomain_of_element;
    sizes.assign(result.skeleton.material_of_subdomain.size(), 1);
    merge_subdomains(pieces.part_of_element, sizes, merges);
  }
}

template <geometry_model G>
distributed_mesh assemble_mesh(const G& model, fine_skeleton skeleton, const meshing_result& meshed) {
  distributed_mesh mesh;
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

/// Generates a tetrahedral mesh of all solids of `model`, sized by `size`.
///
///     auto result = generate<3>(model, uniform_size(2.0), parameters<>{}.with_mesher(mesher::tetgen{}));
///
/// The mesh depends on the model, the field and the parameters, not on the executor or its workers. Throws
/// what the stages throw: typed errors that name the CAD entity concerned. A subdomain that no attempt could
/// mesh is data.
template <int D, geometry_model G, sizing_field H, class Parameters>
  requires(D == 3)
generate_result generate(const G& model, const H& size, const Parameters& given) {
  static_assert(!std::same_as<std::remove_cvref_t<decltype(given.mesh_it)>, no_mesher>,
                "choose a mesher: parameters<>{}.with_mesher(mesher::tetgen{})");
  const stopwatch clock;
  const generate_options& options = given.options;
  generate_result result;
  result.summary.name = "generate";

  auto background = make_background(model, size, given);
  result.background = std::move(background.mesh);
  result.plan = background.plan;
  const background_mesh& coarse = result.background;

  options.on_progress("simplification", 0, 0);
  const stopwatch simplification_clock;
  const side_table<3> sides = build_sides(coarse.volume);
  const auto weights = predict_elements<3>(coarse.volume, size).per_element;
  report simplification_summary;
  const auto simplified = detail::simplify_background(coarse, sides, weights, result.plan.subdomains, options,
                                                      simplification_summary);
  simplification_summary.seconds = simplification_clock.seconds();

  options.on_progress("partition", 0, 0);
  const stopwatch partition_clock;
  auto pieces = decompose<3>(coarse.volume, sides, simplified.super_of_element, simplified.graph,
                             coarse.volume.tags, given.partition_it, result.plan.subdomains);
  result.coarse_contract = detail::coarse_interface_contract(
      coarse, sides, simplified.side_states, pieces.part_of_element, options.interface_angle_deg);
  pieces.summary.seconds = partition_clock.seconds();

  report partition_summary = pieces.summary;
  auto [skeleton, meshed] = detail::realize_and_mesh(model, coarse, sides, simplified.side_states,
                                                     std::move(pieces), weights, keep_bounds(size), given);
  result.subdomain_of_element = skeleton.subdomain_of_element;
  result.fine_contract = check_interface_contract(
      {skeleton.fine.points, skeleton.fine.triangles, skeleton.fine.subdomains, skeleton.origins},
      options.interface_angle_deg);
  result.quality = meshed.quality;
  result.mesh = detail::assemble_mesh(model, std::move(skeleton.fine), meshed);
  result.failures = std::move(meshed.failures);
  result.summary.children = {std::move(background.summary),
                             std::move(simplification_summary),
                             std::move(partition_summary),
                             std::move(skeleton.skeleton_summary),
                             std::move(skeleton.intersection_summary),
                             std::move(meshed.summary)};
  result.summary.seconds = clock.seconds();
  return result;
}

} // namespace dovetail
