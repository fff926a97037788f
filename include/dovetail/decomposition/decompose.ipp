/// @file
/// What `decompose.hpp` declares.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/decomposition/apportion.hpp"
#include "dovetail/decomposition/connected_refinement.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/manifold_repair.hpp"
#include "dovetail/partition/any_partitioner.hpp"
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
  for (local_id v = 0; v < graph.node_count(); ++v) {
    const auto row = graph.row(v);
    const auto begin = static_cast<std::size_t>(graph.offsets[static_cast<std::size_t>(v)]);
    for (std::size_t k = 0; k < row.size(); ++k)
      if (material[static_cast<std::size_t>(v)] == material[static_cast<std::size_t>(row[k])]) {
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
      sums[super] += mesh.points[static_cast<std::size_t>(v)] / (D + 1.0);
    counts[super] += 1;
  }
  for (std::size_t s = 0; s < supers; ++s)
    sums[s] = sums[s] / std::max(1.0, counts[s]);
  return sums;
}

/// One component of a graph; `number` is the number of each node in its component.
inline csr_graph graph_of_component(const csr_graph& graph, std::span<const local_id> nodes,
                                    std::span<const local_id> number) {
  csr_graph component;
  for (const local_id v : nodes) {
    const auto i = static_cast<std::size_t>(v);
    component.node_weights.push_back(graph.node_weights[i]);
    component.positions.push_back(graph.positions[i]);
    for (auto k = static_cast<std::size_t>(graph.offsets[i]);
         k < static_cast<std::size_t>(graph.offsets[i + 1]); ++k) {
      component.neighbours.push_back(number[static_cast<std::size_t>(graph.neighbours[k])]);
      component.edge_weights.push_back(graph.edge_weights[k]);
    }
    component.offsets.push_back(static_cast<std::int64_t>(component.neighbours.size()));
  }
  return component;
}

/// Partitions each component on its own; the parts of one component have consecutive numbers.
inline std::vector<local_id> partition_components(const csr_graph& graph,
                                                  const labelled_components& components,
                                                  const any_partitioner& partitioner,
                                                  std::span<const int> parts_of_component,
                                                  const progress& on_progress) {
  if (components.count == 1)
    return partitioner(graph, parts_of_component[0]);
  const auto nodes_of =
      sorted_into_rows<local_id>(static_cast<std::size_t>(components.count), [&](const auto& put) {
        for (std::size_t v = 0; v < components.of_node.size(); ++v)
          put(components.of_node[v], static_cast<local_id>(v));
      });
  std::vector<local_id> number(graph.node_weights.size());
  for (std::size_t c = 0; c < nodes_of.size(); ++c)
    for (std::size_t k = 0; k < nodes_of[c].size(); ++k)
      number[static_cast<std::size_t>(nodes_of[c][k])] = static_cast<local_id>(k);
  std::vector<local_id> part(number.size(), no_id);
  local_id first_part = 0;
  for (std::size_t c = 0; c < nodes_of.size(); ++c) {
    on_progress.stop_if_requested();
    const auto nodes = nodes_of[c];
    const auto local = partitioner(graph_of_component(graph, nodes, number), parts_of_component[c]);
    for (std::size_t k = 0; k < local.size(); ++k)
      part[static_cast<std::size_t>(nodes[k])] = first_part + local[k];
    first_part += parts_of_component[c];
  }
  return part;
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

} // namespace detail

template <int D>
decomposition decompose(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                        std::span<const local_id> super_of_element, const csr_graph& super_graph,
                        std::span<const local_id> material, const any_partitioner& partitioner, int parts,
                        double imbalance, const progress& on_progress, mesh_state mesh_is) {
  const stopwatch time;
  if (mesh.elements.empty())
    throw partition_error("cannot decompose a mesh without elements");
  detail::require_valid_unless(mesh_is, mesh, sides, "decompose");
  detail::require_partitionable(super_graph, 1);
  detail::require_one_per_element(super_of_element, mesh.elements.size(), super_graph.node_count(),
                                  "decompose", "super-elements");
  if (!material.empty())
    detail::require_one_per_element(material, mesh.elements.size(), std::numeric_limits<local_id>::max(),
                                    "decompose", "materials");
  std::vector<local_id> material_of_super(super_graph.node_weights.size(), 0);
  if (!material.empty())
    for (std::size_t e = 0; e < super_of_element.size(); ++e)
      material_of_super[static_cast<std::size_t>(super_of_element[e])] = material[e];
  csr_graph graph = detail::within_materials(super_graph, material_of_super);
  graph.positions = detail::centres_of_supers<D>(mesh, super_of_element, graph.node_weights.size());
  const labelled_components components = components_within(graph, material_of_super);
  std::vector<double> weights = part_weights(graph, components.of_node, components.count);
  std::vector<local_id> nodes(weights.size(), 0);
  for (const local_id c : components.of_node)
    ++nodes[static_cast<std::size_t>(c)];
  const std::vector<int> parts_of_component = apportion_parts(weights, nodes, parts);

  decomposition result;
  result.part_of_super =
      detail::partition_components(graph, components, partitioner, parts_of_component, on_progress);
  on_progress.stop_if_requested();
  for (const int count : parts_of_component)
    result.parts += count;
  const double cut = edge_cut(graph, result.part_of_super);
  const std::size_t joined = join_stray_components(graph, result.part_of_super, result.parts);
  reassignable_parts<D> reassignable(mesh, sides, super_of_element, graph, result.part_of_super,
                                     detail::part_limits(weights, parts_of_component, imbalance));
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
    result.part_of_element[e] = result.part_of_super[static_cast<std::size_t>(super_of_element[e])];
  result.part_weights = part_weights(graph, result.part_of_super, result.parts);
  result.material_of_part.assign(static_cast<std::size_t>(result.parts), 0);
  for (std::size_t s = 0; s < material_of_super.size(); ++s)
    result.material_of_part[static_cast<std::size_t>(result.part_of_super[s])] = material_of_super[s];

  result.super_of_element.assign(super_of_element.begin(), super_of_element.end());

  report& summary = result.summary;
  summary.name = "partition";
  summary.set("subdomains", result.parts);
  summary.set("components", components.count);
  summary.set("imbalance", imbalance_of(graph, result.part_of_super, result.parts));
  summary.set("cut_of_partitioner", cut);
  summary.set("cut", edge_cut(graph, result.part_of_super));
  summary.set("joined_strays", static_cast<double>(joined));
  summary.set("repaired_super_elements", static_cast<double>(repaired));
  summary.set("refined_super_elements", static_cast<double>(refined));
  summary.set("non_manifold_edges", result.non_manifold_edges);
  summary.set("non_manifold_points", static_cast<double>(result.defective_points.size()));
  if (!result.defective_points.empty())
    summary.warnings.push_back("subdomain boundaries are not manifold at " +
                               std::to_string(result.defective_points.size()) +
                               " points, the first is point " +
                               std::to_string(result.defective_points.front()) + " of the coarse mesh");
  result.graph = std::move(graph);
  summary.seconds = time.seconds();
  return result;
}

#ifdef DOVETAIL_COMPILED
template decomposition decompose<2>(const simplicial_mesh<2>& mesh, const side_table<2>& sides,
                                    std::span<const local_id> super_of_element, const csr_graph& super_graph,
                                    std::span<const local_id> material, const any_partitioner& partitioner,
                                    int parts, double imbalance, const progress& on_progress,
                                    mesh_state mesh_is);
template decomposition decompose<3>(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                                    std::span<const local_id> super_of_element, const csr_graph& super_graph,
                                    std::span<const local_id> material, const any_partitioner& partitioner,
                                    int parts, double imbalance, const progress& on_progress,
                                    mesh_state mesh_is);
#endif

} // namespace dovetail
