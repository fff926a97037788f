/// @file
/// From a simplified mesh to subdomains: connected, of one material, with manifold boundaries.
///
/// The whole chain for a solid, on plain data (weights = predicted final elements per coarse element):
///
///     const auto sides = build_sides(volume); // simplicial_mesh<3>, tags = materials
///     const auto simplified =
///         simplify_coupled({surface, {.fixed_sides = edges_on_cad_curves}},
///                          {volume, sides, {.element_weights = weights}}, simplifier::paper{},
///                          {.subdomains = 32});
///     const auto pieces =
///         decompose<3>(volume, sides, simplified.volume.super_of_element, simplified.volume.graph,
///                      volume.tags, partition::metis{}, 32);
///     const auto angles =
///         measure_interface_angles<3>({volume, sides, simplified.volume.side_states,
///                                      pieces.part_of_element},
///                                     wanted_angles_of<3>(simplifier::paper{})); // angles_of_rule.hpp
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/decomposition/manifold_repair.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/partition/checked_partition.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/connectivity.hpp"
#include "dovetail/partition/node_groups.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// What is allowed of the heaviest part over the average, unless something else is asked for.
inline constexpr double largest_imbalance = 1.05;

/// Who owns which element.
struct decomposition {
  std::vector<local_id> part_of_element;  ///< a part for each element of the mesh
  local_id parts = 0;                     ///< how many parts there are
  std::vector<local_id> material_of_part; ///< the elements' tag; 0 without tags
  std::vector<double> part_weights;       ///< by part: the sum of its elements' weights
  std::vector<local_id> part_of_super;    ///< a part for each super-element
  std::vector<local_id> super_of_element; ///< a super-element for each element
  csr_graph graph;                        ///< of the super-elements, within materials
  /// Points where the boundary of some part is not manifold and could not be made so; empty if all are.
  std::vector<local_id> defective_points;
  int non_manifold_edges = 0; ///< pairs of sides too many at an edge; some meshers cannot take these
  report summary;             ///< what was counted on the way

  using fields =
      field_list<&decomposition::part_of_element, &decomposition::parts, &decomposition::material_of_part,
                 &decomposition::part_weights, &decomposition::part_of_super,
                 &decomposition::super_of_element, &decomposition::graph, &decomposition::defective_points,
                 &decomposition::non_manifold_edges, &decomposition::summary>;
};

/// What is counted of a decomposition.
struct partition_counts {
  local_id subdomains = 0;                 ///< how many there are
  local_id components = 0;                 ///< of the graph, within materials
  double imbalance = 0;                    ///< the heaviest subdomain over the average
  double cut_of_partitioner = 0;           ///< weight of the sides between parts as the partitioner made them
  double cut = 0;                          ///< likewise of what became of them
  std::size_t joined_strays = 0;           ///< parts of subdomains that were not connected with the rest
  std::size_t repaired_super_elements = 0; ///< moved so that boundaries are manifold
  std::size_t refined_super_elements = 0;  ///< moved so that the cut is less
  int non_manifold_edges = 0;              ///< of boundaries, pairs of sides too many
  std::size_t non_manifold_points = 0;     ///< of boundaries

  using fields =
      field_list<&partition_counts::subdomains, &partition_counts::components, &partition_counts::imbalance,
                 &partition_counts::cut_of_partitioner, &partition_counts::cut,
                 &partition_counts::joined_strays, &partition_counts::repaired_super_elements,
                 &partition_counts::refined_super_elements, &partition_counts::non_manifold_edges,
                 &partition_counts::non_manifold_points>;
};

namespace detail {

/// The super-elements of a mesh as they are partitioned: within materials, each component on its own.
struct graph_to_partition {
  csr_graph graph;
  std::vector<local_id> material_of_super;
  labelled_components components;
  std::vector<double> weights; ///< of components
  std::vector<int> parts;      ///< of components

  using fields =
      field_list<&graph_to_partition::graph, &graph_to_partition::material_of_super,
                 &graph_to_partition::components, &graph_to_partition::weights, &graph_to_partition::parts>;
};

/// Throws what `decompose` throws of its arguments.
template <int D>
graph_to_partition graph_within_materials(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                                          std::span<const local_id> super_of_element,
                                          const csr_graph& super_graph, std::span<const local_id> material,
                                          int parts, mesh_state mesh_is);

/// What a partition makes of the mesh, repaired.
template <int D>
decomposition decomposition_into(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                                 std::span<const local_id> super_of_element, graph_to_partition whole,
                                 std::vector<local_id> part_of_super, double imbalance,
                                 const progress& on_progress);

/// Partitions each component; the parts of one component have consecutive numbers.
template <graph_partitioner Partitioner>
std::vector<local_id> partition_components(const graph_to_partition& whole, const Partitioner& partitioner,
                                           const progress& on_progress) {
  if (whole.components.count == 1)
    return checked_partition(partitioner, whole.graph, whole.parts[0]);
  const node_groups of_component(whole.graph, whole.components.of_node, whole.components.count);
  std::vector<std::vector<local_id>> parts_of_component;
  for (std::size_t c = 0; c < of_component.size(); ++c) {
    on_progress.stop_if_requested();
    parts_of_component.push_back(checked_partition(partitioner, of_component.graph_of(c), whole.parts[c]));
  }
  return of_component.joined(parts_of_component, whole.parts);
}

} // namespace detail

/// Splits a simplified mesh into about `parts` subdomains (at least one per component of one material).
///
/// `material` has one entry per element, or is empty: `mesh.tags` for D = 3; empty for D = 2 when subsurfaces
/// may cross CAD curves. Every subdomain is non-empty and connected through sides; its boundary is
/// manifold but at `defective_points`. Parts are kept under `imbalance` times the average of their component
/// where that is possible. Deterministic for a deterministic partitioner. Throws `partition_error` when the
/// mesh is empty or the partitioner fails, `mesh_error` when `require_valid` refuses the mesh, unless it is
/// known to be valid, `usage_error` when super-elements and materials are not one per element, and
/// `cancelled` when `on_progress` asks to stop; a partitioner is not interrupted.
/// Complexity: that of the partitioner; the rest is about linear in the mesh.
/// \param mesh D = 2: triangles; D = 3: tetrahedra
/// \param sides `build_sides(mesh)`
/// \param super_of_element per element its super-element, from 0
/// \param super_graph a node per super-element; `simplify` makes both
/// \param material per element a number, or empty; no part has two materials
/// \param partitioner divides the graph of each material's component
/// \param parts how many subdomains are wanted, at least 1
/// \param imbalance largest weight of a part over the average, > 1
/// \param on_progress is told of progress and may ask to stop (`cancelled`)
/// \param mesh_is `mesh_state::valid` skips the checks of a mesh known to be valid
template <int D, graph_partitioner Partitioner>
decomposition decompose(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                        std::span<const local_id> super_of_element, const csr_graph& super_graph,
                        std::span<const local_id> material, const Partitioner& partitioner, int parts,
                        double imbalance = largest_imbalance, const progress& on_progress = {},
                        mesh_state mesh_is = mesh_state::unknown) {
  const stopwatch time;
  auto whole =
      detail::graph_within_materials<D>(mesh, sides, super_of_element, super_graph, material, parts, mesh_is);
  auto part_of_super = detail::partition_components(whole, partitioner, on_progress);
  auto result = detail::decomposition_into<D>(mesh, sides, super_of_element, std::move(whole),
                                              std::move(part_of_super), imbalance, on_progress);
  result.summary.seconds = time.seconds();
  return result;
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/decompose.ipp"
#endif
