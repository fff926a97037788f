/// @file
/// What `divide.hpp` declares.
#pragma once

#include "dovetail/background/coarse_volume.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/pipeline/dimension_steps.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/simplification/angles_of_rule.hpp"
#include "dovetail/sizing/prediction.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The first step of the prediction of elements, which for a large background mesh is most of it, in tasks.
template <int D>
std::vector<integral_estimate> integrate_in_tasks(const simplicial_mesh<D>& mesh, const any_sizing& size,
                                                  const any_executor& run_tasks,
                                                  const progress& on_progress) {
  constexpr std::size_t elements_per_task = 10'000; // some 30 ms
  const std::size_t elements = mesh.elements.size();
  auto results = map_tasks(
      run_tasks, (elements + elements_per_task - 1) / elements_per_task,
      [&](std::size_t task) {
        const std::size_t first = task * elements_per_task;
        return integrate_elements(mesh, size, first, std::min(elements, first + elements_per_task));
      },
      run_options{.on_progress = on_progress, .stage = "simplification"});
  std::vector<integral_estimate> estimates;
  estimates.reserve(elements);
  for (const auto& part : values_of(std::move(results), "the prediction of elements"))
    append(estimates, part);
  return estimates;
}

/// Where the mesh comes in: the steps after that do not look again. In D = 2 a coarse triangle on a face of
/// no width is flat, and turned over against nothing.
inline void require_background(const simplicial_background<3>& coarse, const side_table<3>& sides) {
  require_valid(coarse.volume, sides, "the background mesh");
}
inline void require_background(const simplicial_background<2>& coarse, const side_table<2>& sides) {
  require_valid(coarse.surface.mesh, sides, "the background mesh", {.orientation = false});
}

template <int D, bound_parameters<D> Parameters>
divided_background<D> divide_here(const simplicial_background<D>& coarse, const side_table<D>& sides,
                                  const any_sizing& size, std::span<const integral_estimate> estimates,
                                  int subdomains, const Parameters& given) {
  const generate_options& options = given.options;
  divided_background<D> result;
  options.on_progress("simplification", 0, 0);
  const stopwatch simplification_clock;
  result.weights = predict_elements<D>(coarse.elements(), size, {}, estimates).per_element;
  contraction_bound bound = options.super_elements;
  bound.subdomains = subdomains;
  const std::span<const double> weights =
      options.predicted_weights ? span_of(result.weights) : std::span<const double>(); // else 1 each
  auto simplified = simplify_background(coarse, sides, weights, bound, given.simplify_by,
                                        result.simplification, options.on_progress);
  result.simplification.seconds = simplification_clock.seconds();

  options.on_progress("partition", 0, 0);
  const stopwatch partition_clock;
  result.pieces = decompose<D>(coarse.elements(), sides, simplified.super_of_element, simplified.graph,
                               materials_of(coarse), given.partition_it, subdomains, 1.05,
                               options.on_progress, mesh_state::valid);
  result.angles =
      coarse_interface_angles(coarse, sides, simplified.side_states, result.pieces.part_of_element, size,
                              wanted_angles_of<D>(given.simplify_by));
  result.side_states = std::move(simplified.side_states);
  result.partition = std::move(result.pieces.summary);
  result.partition.seconds = partition_clock.seconds();
  return result;
}

} // namespace detail

template <int D, bound_parameters<D> Parameters>
divided_background<D> divide(const simplicial_background<D>& coarse, const any_sizing& size, int subdomains,
                             const Parameters& given) {
  const stopwatch clock;
  side_table<D> sides = build_sides(coarse.elements());
  detail::require_background(coarse, sides);
  const auto estimates =
      detail::integrate_in_tasks<D>(coarse.elements(), size, given.run_tasks, given.options.on_progress);
  const double seconds_before = clock.seconds();
  auto result = given.run_tasks.once(
      [&] { return detail::divide_here<D>(coarse, sides, size, estimates, subdomains, given); });
  if constexpr (D == 3)
    result.beside_surface = elements_beside_surface(coarse, sides);
  result.sides = std::move(sides);
  result.simplification.seconds += seconds_before;
  return result;
}

DOVETAIL_INLINE divided_background<3> leave_undivided(const surface_mesh& surface,
                                                      const geometry_topology& topology) {
  const std::size_t solids = topology.solids.size();
  divided_background<3> result;
  result.beside_surface = background::solids_beside_surface(surface, topology);
  result.pieces.part_of_element.resize(solids);
  std::iota(result.pieces.part_of_element.begin(), result.pieces.part_of_element.end(), local_id{0});
  result.pieces.parts = static_cast<local_id>(solids);
  result.simplification.name = "simplification";
  result.partition.name = "partition";
  result.partition.set(partition_counts{.subdomains = result.pieces.parts, .imbalance = 1});
  return result;
}

#ifdef DOVETAIL_COMPILED
template divided_background<2> divide<2>(const simplicial_background<2>& coarse, const any_sizing& size,
                                         int subdomains, const any_parameters<2>& given);
template divided_background<3> divide<3>(const simplicial_background<3>& coarse, const any_sizing& size,
                                         int subdomains, const any_parameters<3>& given);
#endif

} // namespace dovetail
