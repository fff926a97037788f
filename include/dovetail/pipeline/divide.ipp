/// @file
/// What `divide.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/interface_angles_codec.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/parallel/final_errors.hpp"
#include "dovetail/parallel/run_task.hpp"
#include "dovetail/pipeline/dimension_steps.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/sizing/prediction.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The first step of the prediction of elements, which for a large background mesh is most of it, in tasks.
template <int D>
std::vector<integral_estimate> integrate_in_tasks(const simplicial_mesh<D>& mesh, const any_sizing& size,
                                                  const any_parameters<D>& given) {
  constexpr std::size_t elements_per_task = 10'000; // some 30 ms
  const std::size_t elements = mesh.elements.size();
  const auto outcomes = given.run_tasks.run(
      (elements + elements_per_task - 1) / elements_per_task,
      [&](std::size_t task) {
        return with_final_errors([&] {
          const std::size_t first = task * elements_per_task;
          byte_writer to;
          to.array(integrate_elements(mesh, size, first, std::min(elements, first + elements_per_task)));
          return to.take();
        });
      },
      run_options{.on_progress = given.options.on_progress, .stage = "simplification"});
  std::vector<integral_estimate> estimates;
  estimates.reserve(elements);
  for (const task_outcome& outcome : outcomes) {
    require_done(outcome, "the prediction of elements");
    append(estimates, byte_reader(without_final_errors(outcome.result)).template array<integral_estimate>());
  }
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

template <int D>
divided_background<D> divide_here(const simplicial_background<D>& coarse, const any_sizing& size,
                                  std::span<const integral_estimate> estimates, int subdomains,
                                  const any_parameters<D>& given) {
  const generate_options& options = given.options;
  divided_background<D> result;
  options.on_progress("simplification", 0, 0);
  const stopwatch simplification_clock;
  result.sides = build_sides(coarse.elements());
  require_background(coarse, result.sides);
  result.weights = predict_elements<D>(coarse.elements(), size, {}, estimates).per_element;
  contraction_bound bound = options.super_elements;
  bound.subdomains = subdomains;
  auto simplified = simplify_background(coarse, result.sides, result.weights, bound, given.simplify_by,
                                        result.simplification, options.on_progress);
  result.simplification.seconds = simplification_clock.seconds();

  options.on_progress("partition", 0, 0);
  const stopwatch partition_clock;
  result.pieces = decompose<D>(coarse.elements(), result.sides, simplified.super_of_element, simplified.graph,
                               materials_of(coarse), given.partition_it, subdomains, 1.05,
                               options.on_progress, mesh_state::valid);
  result.angles = coarse_interface_angles(coarse, result.sides, simplified.side_states,
                                          result.pieces.part_of_element, size, options);
  result.side_states = std::move(simplified.side_states);
  result.partition = std::move(result.pieces.summary);
  result.partition.seconds = partition_clock.seconds();
  return result;
}

/// What the steps after it do with a division: all but the reports.
template <int D>
byte_buffer encode(const divided_background<D>& divided) {
  byte_writer to;
  to.array(divided.weights);
  to.array(divided.side_states);
  to.array(divided.pieces.part_of_element);
  to.value(divided.pieces.parts);
  to.array(divided.pieces.material_of_part);
  to.array(divided.pieces.part_weights);
  to.array(divided.pieces.part_of_super);
  to.array(divided.pieces.super_of_element);
  const csr_graph& graph = divided.pieces.graph;
  to.array(graph.offsets);
  to.array(graph.neighbours);
  to.array(graph.edge_weights);
  to.array(graph.node_weights);
  to.array(graph.positions);
  to.array(divided.pieces.defective_points);
  to.value(divided.pieces.non_manifold_edges);
  encode(to, divided.angles);
  return to.take();
}

template <int D>
divided_background<D> decode_division(const simplicial_background<D>& coarse, const byte_buffer& bytes) {
  byte_reader from(bytes);
  divided_background<D> divided;
  divided.sides = build_sides(coarse.elements());
  divided.weights = from.array<double>();
  divided.side_states = from.array<side_state>();
  divided.pieces.part_of_element = from.array<local_id>();
  divided.pieces.parts = from.value<local_id>();
  divided.pieces.material_of_part = from.array<local_id>();
  divided.pieces.part_weights = from.array<double>();
  divided.pieces.part_of_super = from.array<local_id>();
  divided.pieces.super_of_element = from.array<local_id>();
  csr_graph& graph = divided.pieces.graph;
  graph.offsets = from.array<std::int64_t>();
  graph.neighbours = from.array<local_id>();
  graph.edge_weights = from.array<double>();
  graph.node_weights = from.array<double>();
  graph.positions = from.array<vec3>();
  divided.pieces.defective_points = from.array<local_id>();
  divided.pieces.non_manifold_edges = from.value<int>();
  divided.angles = decode_interface_angles(from);
  return divided;
}

} // namespace detail

template <int D>
divided_background<D> divide(const simplicial_background<D>& coarse, const any_sizing& size, int subdomains,
                             const any_parameters<D>& given) {
  const any_executor& run = given.run_tasks;
  const stopwatch clock;
  const auto estimates = detail::integrate_in_tasks<D>(coarse.elements(), size, given);
  const double integration_seconds = clock.seconds();
  divided_background<D> result;
  const byte_buffer known = run.once([&] {
    result = detail::divide_here<D>(coarse, size, estimates, subdomains, given);
    result.simplification.seconds += integration_seconds;
    return run.has_others() ? detail::encode(result) : byte_buffer{};
  });
  return run.leads() ? std::move(result) : detail::decode_division<D>(coarse, known);
}

DOVETAIL_INLINE divided_background<3> leave_undivided(const simplicial_background<3>& cones,
                                                      std::size_t solids) {
  divided_background<3> result;
  result.sides = build_sides(cones.volume);
  result.weights.assign(cones.volume.elements.size(), 1);
  result.side_states.assign(result.sides.size(), side_state::kept);
  result.pieces.part_of_element = cones.volume.tags;
  result.pieces.parts = static_cast<local_id>(solids);
  result.simplification.name = "simplification";
  result.partition.name = "partition";
  result.partition.set("subdomains", static_cast<double>(solids));
  result.partition.set("imbalance", 1);
  return result;
}

#ifdef DOVETAIL_COMPILED
template divided_background<2> divide<2>(const simplicial_background<2>& coarse, const any_sizing& size,
                                         int subdomains, const any_parameters<2>& given);
template divided_background<3> divide<3>(const simplicial_background<3>& coarse, const any_sizing& size,
                                         int subdomains, const any_parameters<3>& given);
#endif

} // namespace dovetail
