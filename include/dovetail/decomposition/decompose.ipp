/// @file
/// What `decompose.hpp` declares.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/decomposition/connected_refinement.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/manifold_repair.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/apportion.hpp"
#include "dovetail/partition/connectivity.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The graph of super-elements without the edges that cross a material face.
inline csr_graph within_materials(const csr_graph& graph, std::span<const local_id> material) {
  csr_graph filtered;
  filtered.node_weights = graph.node_weights;
  filtered.offsets.reserve(graph.offsets.size());
  filtered.neighbours.reserve(graph.neighbours.size());
  filtered.edge_weights.reserve(graph.neighbours.size());
  for (local_id v = 0; v < graph.node_count(); ++v) {
    const auto row = graph.row(v);
    const auto begin = static_cast<std::size_t>(graph.offsets[v]);
    for (std::size_t k = 0; k < row.size(); ++k)
      if (material[v] == material[row[k]]) {
        filtered.neighbours.push_back(row[k]);
        filtered.edge_weights.push_back(graph.edge_weights[begin + k]);
      }
    filtered.offsets.push_back(static_cast<std::int64_t>(filtered.neighbours.size()));
  }
  return filtered;
}

/// The mean of the centres of each super-element's elements, for partitioners that go by place.
template <int D>
std::vector<vec3> centres_of_supers(const simplicial_mesh<D>& mesh,
                                    std::span<const local_id> super_of_element, std::size_t supers) {
  std::vector<vec3> sums(supers);
  std::vector<double> counts(supers, 0.0);
  for (std::size_t e = 0; e < super_of_element.size(); ++e) {
    const auto super = static_cast<std::size_t>(super_of_element[e]);
    for (const local_id v : mesh.elements[e])
      sums[super] += mesh.points[v] / (D + 1.0);
    counts[super] += 1;
  }
  for (std::size_t s = 0; s < supers; ++s)
    sums[s] = sums[s] / std::max(1.0, counts[s]);
  return sums;
}

/// The limit of every part: `imbalance` times the average of its component.
inline std::vector<double> part_limits(std::span<const double> component_weights,
                                       std::span<const int> parts_of_component, double imbalance) {
  std::vector<double> limits;
  for (std::size_t c = 0; c < component_weights.size(); ++c)
    limits.insert(limits.end(), static_cast<std::size_t>(parts_of_component[c]),
                  imbalance * component_weights[c] / parts_of_component[c]);
  return limits;
}

template <int D>
graph_to_partition graph_within_materials(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                                          std::span<const local_id> super_of_element,
                                          const csr_graph& super_graph, std::span<const local_id> material,
                                          int parts, mesh_state mesh_is) {
  if (mesh.elements.empty())
    throw partition_error("cannot decompose a mesh without elements");
  require_valid_unless(mesh_is, mesh, sides, "decompose");
  require_partitionable(super_graph, 1);
  require_one_per_element(super_of_element, mesh.elements.size(), super_graph.node_count(), "decompose",
                          "super-elements");
  if (!material.empty())
    require_one_per_element(material, mesh.elements.size(), std::numeric_limits<local_id>::max(), "decompose",
                            "materials");
  graph_to_partition whole;
  whole.material_of_super.assign(super_graph.node_weights.size(), 0);
  if (!material.empty())
    for (std::size_t e = 0; e < super_of_element.size(); ++e)
      whole.material_of_super[super_of_element[e]] = material[e];
  whole.graph = within_materials(super_graph, whole.material_of_super);
  whole.graph.positions = centres_of_supers<D>(mesh, super_of_element, whole.graph.node_weights.size());
  whole.components = components_within(whole.graph, whole.material_of_super);
  whole.weights = part_weights(whole.graph, whole.components.of_node, whole.components.count);
  std::vector<local_id> nodes(whole.weights.size(), 0);
  for (const local_id c : whole.components.of_node)
    ++nodes[c];
  whole.parts = apportion_parts(whole.weights, nodes, parts);
  return whole;
}

/// Of points where boundaries of parts are not manifold those where the materials' own boundaries have fewer
/// defects: elsewhere the model is what it is, as where two solids touch, and no decomposition does better.
template <int D>
std::vector<local_id> avoidable_defects(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                                        const decomposition& made) {
  std::vector<local_id> avoidable;
  if (made.defective_points.empty())
    return avoidable;
  boundary_defects<D> defects(mesh, sides);
  const auto part_of = [&](local_id e) { return made.part_of_element[e]; };
  const auto material_of = [&](local_id e) { return made.material_of_part[part_of(e)]; };
  for (const local_id p : made.defective_points) {
    const defect_count of_parts = defects.count_at(p, part_of), of_model = defects.count_at(p, material_of);
    if (of_parts.edges > of_model.edges || of_parts.points > of_model.points)
      avoidable.push_back(p);
  }
  return avoidable;
}

template <int D>
decomposition decomposition_into(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                                 std::span<const local_id> super_of_element, graph_to_partition whole,
                                 std::vector<local_id> part_of_super, double imbalance,
                                 const progress& on_progress) {
  const csr_graph& graph = whole.graph;
  decomposition result;
  result.part_of_super = std::move(part_of_super);
  on_progress.stop_if_requested();
  for (const int count : whole.parts)
    result.parts += count;
  const double cut = edge_cut(graph, result.part_of_super);
  const std::size_t joined = join_stray_components(graph, result.part_of_super, result.parts);
  reassignable_parts<D> reassignable(mesh, sides, super_of_element, graph, result.part_of_super,
                                     part_limits(whole.weights, whole.parts, imbalance));
  manifold_repair<D> repair(reassignable, on_progress);
  repair.run();
  const std::size_t repaired = reassignable.assignments();
  connected_refinement<D>(reassignable, on_progress).run();
  repair.run();
  const std::size_t refined = reassignable.assignments() - repaired;
  result.defective_points = repair.defective_points();
  result.non_manifold_edges = repair.total_defects().edges / 2;

  result.part_of_element.resize(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    result.part_of_element[e] = result.part_of_super[super_of_element[e]];
  result.part_weights = part_weights(graph, result.part_of_super, result.parts);
  result.material_of_part.assign(static_cast<std::size_t>(result.parts), 0);
  for (std::size_t s = 0; s < whole.material_of_super.size(); ++s)
    result.material_of_part[result.part_of_super[s]] = whole.material_of_super[s];

  result.super_of_element.assign(super_of_element.begin(), super_of_element.end());

  report& summary = result.summary;
  summary.name = "partition";
  summary.set(partition_counts{.subdomains = result.parts,
                               .components = whole.components.count,
                               .imbalance = imbalance_of(graph, result.part_of_super, result.parts),
                               .cut_of_partitioner = cut,
                               .cut = edge_cut(graph, result.part_of_super),
                               .joined_strays = joined,
                               .repaired_super_elements = repaired,
                               .refined_super_elements = refined,
                               .non_manifold_edges = result.non_manifold_edges,
                               .non_manifold_points = result.defective_points.size()});
  if (const auto points = avoidable_defects(mesh, sides, result); !points.empty())
    summary.warnings.push_back("subdomain boundaries are not manifold at " + std::to_string(points.size()) +
                               " points, the first is point " + std::to_string(points.front()) +
                               " of the coarse mesh");
  result.graph = std::move(whole.graph);
  return result;
}

} // namespace detail

#ifdef DOVETAIL_COMPILED
template detail::graph_to_partition
detail::graph_within_materials(const simplicial_mesh<2>&, const side_table<2>&, std::span<const local_id>,
                               const csr_graph&, std::span<const local_id>, int, mesh_state);
template detail::graph_to_partition
detail::graph_within_materials(const simplicial_mesh<3>&, const side_table<3>&, std::span<const local_id>,
                               const csr_graph&, std::span<const local_id>, int, mesh_state);
template decomposition detail::decomposition_into(const simplicial_mesh<2>&, const side_table<2>&,
                                                  std::span<const local_id>, graph_to_partition,
                                                  std::vector<local_id>, double, const progress&);
template decomposition detail::decomposition_into(const simplicial_mesh<3>&, const side_table<3>&,
                                                  std::span<const local_id>, graph_to_partition,
                                                  std::vector<local_id>, double, const progress&);
#endif

} // namespace dovetail
