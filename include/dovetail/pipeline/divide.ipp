/// @file
/// What `divide.hpp` declares.
#pragma once

#include "dovetail/background/coarse_volume.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/partition/in_groups.hpp"
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

/// A background mesh simplified, and its super-elements as they are partitioned.
struct simplified_background {
  std::vector<double> weights;
  std::vector<side_state> side_states;
  std::vector<local_id> super_of_element;
  graph_to_partition whole;
  report summary;

  using fields = field_list<&simplified_background::weights, &simplified_background::side_states,
                            &simplified_background::super_of_element, &simplified_background::whole,
                            &simplified_background::summary>;
};

template <int D, bound_parameters<D> Parameters>
simplified_background simplify_here(const simplicial_background<D>& coarse, const side_table<D>& sides,
                                    const any_sizing& size, std::span<const integral_estimate> estimates,
                                    int subdomains, const Parameters& given) {
  const generate_options& options = given.options;
  simplified_background result;
  result.weights = predict_elements<D>(coarse.elements(), size, {}, estimates).per_element;
  contraction_bound bound = options.super_elements;
  bound.subdomains = subdomains;
  const std::span<const double> weights =
      options.predicted_weights ? span_of(result.weights) : std::span<const double>(); // else 1 each
  auto simplified = simplify_background(coarse, sides, weights, bound, given.simplify_by, result.summary,
                                        options.on_progress);
  result.whole =
      graph_within_materials<D>(coarse.elements(), sides, simplified.super_of_element, simplified.graph,
                                materials_of(coarse), subdomains, mesh_state::valid);
  result.side_states = std::move(simplified.side_states);
  result.super_of_element = std::move(simplified.super_of_element);
  return result;
}

/// A large graph in tasks; one that is not is partitioned at once.
template <class Parameters>
std::vector<local_id> partition_of(const graph_to_partition& whole, const Parameters& given) {
  const progress& on_progress = given.options.on_progress;
  if (whole.graph.node_count() > given.options.partitioned_at_once) {
    partition::in_groups by_groups{given.partition_it, given.run_tasks};
    by_groups.imbalance = largest_imbalance;
    by_groups.nodes_per_group = std::max(1, given.options.partitioned_at_once / 12);
    by_groups.on_progress = on_progress;
    return partition_components(whole, by_groups, on_progress);
  }
  return once(given.run_tasks, [&] { return partition_components(whole, given.partition_it, on_progress); });
}

template <int D, bound_parameters<D> Parameters>
divided_background<D> divide_into(const simplicial_background<D>& coarse, const side_table<D>& sides,
                                  const any_sizing& size, simplified_background simplified,
                                  std::vector<local_id> part_of_super, const Parameters& given) {
  divided_background<D> result;
  result.pieces = decomposition_into<D>(coarse.elements(), sides, simplified.super_of_element,
                                        std::move(simplified.whole), std::move(part_of_super),
                                        largest_imbalance, given.options.on_progress);
  result.angles =
      coarse_interface_angles(coarse, sides, simplified.side_states, result.pieces.part_of_element, size,
                              wanted_angles_of<D>(given.simplify_by));
  result.weights = std::move(simplified.weights);
  result.side_states = std::move(simplified.side_states);
  result.simplification = std::move(simplified.summary);
  result.partition = std::move(result.pieces.summary);
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
  given.options.on_progress("simplification", 0, 0);
  auto simplified = once(given.run_tasks, [&] {
    return detail::simplify_here<D>(coarse, sides, size, estimates, subdomains, given);
  });
  const double simplification_seconds = clock.seconds();
  given.options.on_progress("partition", 0, 0);
  auto part_of_super = detail::partition_of(simplified.whole, given);
  auto result = once(given.run_tasks, [&] {
    return detail::divide_into<D>(coarse, sides, size, std::move(simplified), std::move(part_of_super),
                                  given);
  });
  result.simplification.seconds = simplification_seconds;
  result.partition.seconds = clock.seconds() - simplification_seconds;
  if constexpr (D == 3)
    result.beside_surface = elements_beside_surface(coarse, sides);
  result.sides = std::move(sides);
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
