/// @file
/// From a simplified mesh to subdomains: connected, of one material, with manifold boundaries.
///
/// The whole chain for a solid, on plain data (weights = predicted final elements per coarse element):
///
///     const auto sides = build_sides(volume); // simplicial_mesh<3>, tags = materials
///     const auto simplified =
///         simplify_coupled({surface, {.fixed_sides = edges_on_cad_curves}},
///                          {volume, sides, {.element_weights = weights}}, simplifier::paper{},
///                          {.subdomains = parts});
///     const auto parts =
///         decompose<3>(volume, sides, simplified.volume.super_of_element, simplified.volume.graph,
///                      volume.tags, partition::metis{}, parts);
///     const auto angles =
///         measure_interface_angles<3>({volume, sides, simplified.volume.side_states, parts.part_of_element},
///                                     wanted_angles_of<3>(simplifier::paper{}));
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/progress.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/decomposition/manifold_repair.hpp"
#include "dovetail/mesh/require_valid.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <span>
#include <vector>

namespace dovetail {

/// Who owns which element.
struct decomposition {
  std::vector<local_id> part_of_element;
  local_id parts = 0;
  std::vector<local_id> material_of_part; ///< the elements' tag; 0 without tags
  std::vector<double> part_weights;
  std::vector<local_id> part_of_super;
  std::vector<local_id> super_of_element;
  csr_graph graph; ///< of the super-elements, within materials
  /// Points where the boundary of some part is not manifold and could not be made so; empty if all are.
  std::vector<local_id> defective_points;
  int non_manifold_edges = 0; ///< pairs of sides too many at an edge; some meshers cannot take these
  report summary;

  using fields =
      field_list<&decomposition::part_of_element, &decomposition::parts, &decomposition::material_of_part,
                 &decomposition::part_weights, &decomposition::part_of_super,
                 &decomposition::super_of_element, &decomposition::graph, &decomposition::defective_points,
                 &decomposition::non_manifold_edges, &decomposition::summary>;
};

/// Splits a simplified mesh into about `parts` subdomains (at least one per component of one material).
///
/// `material` has one entry per element, or is empty: `mesh.tags` for D = 3; empty for D = 2 when subsurfaces
/// may cross CAD curves. Every subdomain is non-empty and connected through sides; its boundary is
/// manifold but at `defective_points`. Parts are kept under `imbalance` times the average of their component
/// where that is possible. Deterministic for a deterministic partitioner. Throws `partition_error` when the
/// mesh is empty or the partitioner fails, `mesh_error` when `require_valid` refuses the mesh, unless it is
/// known to be valid, `usage_error` when super-elements and materials are not one per element, and
/// `cancelled` when `on_progress` asks to stop; a partitioner is not interrupted.
template <int D>
decomposition decompose(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                        std::span<const local_id> super_of_element, const csr_graph& super_graph,
                        std::span<const local_id> material, const any_partitioner& partitioner, int parts,
                        double imbalance = 1.05, const progress& on_progress = {},
                        mesh_state mesh_is = mesh_state::unknown);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/decompose.ipp"
#endif
