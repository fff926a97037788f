/// @file
/// Building and contracting graphs.
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/graph/csr_graph.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// An undirected edge of a list.
struct weighted_edge {
  local_id a = no_id; ///< one end
  local_id b = no_id; ///< the other end
  double weight = 1;  ///< counts when the edge is cut
};

/// The graph with the given nodes and edges: parallel edges are merged (weights added), self loops dropped,
/// rows sorted. Throws `usage_error` when an end is not a node. Linear but for sorting the rows.
/// \param node_weights one per node
/// \param edges each once, in either direction
csr_graph make_csr_graph(std::vector<double> node_weights, const std::vector<weighted_edge>& edges);

/// The mean position of the nodes of each label; empty when the graph has no positions.
std::vector<vec3> mean_positions(std::span<const vec3> positions, std::span<const local_id> label,
                                 local_id labels);

/// The graph whose nodes are the labels [0, labels): node weights and the weights of edges that become
/// parallel add up, edges inside a label vanish, positions are averaged.
/// Linear but for sorting the rows. Throws nothing but for a lack of memory; labels are not checked.
/// \param graph any weighted graph
/// \param label per node its label
/// \param labels how many labels there are
template <weighted_graph G>
csr_graph contract(const G& graph, std::span<const local_id> label, local_id labels) {
  std::vector<double> weights(static_cast<std::size_t>(labels), 0.0);
  std::vector<weighted_edge> edges;
  for (local_id v = 0; v < static_cast<local_id>(graph.node_count()); ++v) {
    const local_id a = label[v];
    weights[a] += graph.node_weight(v);
    graph.for_each_edge(v, [&](local_id w, double weight) {
      if (v < w)
        edges.push_back({a, label[w], weight});
    });
  }
  csr_graph contracted = make_csr_graph(std::move(weights), edges);
  contracted.positions = mean_positions(positions_of(graph), label, labels);
  return contracted;
}

/// A part of a graph with the numbers its nodes have in the whole.
struct subgraph {
  csr_graph graph;             ///< the part, its nodes numbered from 0
  std::vector<local_id> nodes; ///< of the whole, growing
};

/// The graph induced by the nodes whose `label` equals `wanted`. Linear in the size of the whole graph.
template <weighted_graph G>
subgraph induced_subgraph(const G& graph, std::span<const local_id> label, local_id wanted) {
  subgraph part;
  std::vector<local_id> number(label.size(), no_id);
  for (std::size_t v = 0; v < label.size(); ++v)
    if (label[v] == wanted) {
      number[v] = static_cast<local_id>(part.nodes.size());
      part.nodes.push_back(static_cast<local_id>(v));
    }
  const std::span<const vec3> positions = positions_of(graph);
  for (const local_id v : part.nodes) {
    part.graph.node_weights.push_back(graph.node_weight(v));
    if (!positions.empty())
      part.graph.positions.push_back(positions[v]);
    graph.for_each_edge(v, [&](local_id w, double weight) {
      if (const local_id other = number[w]; other != no_id) {
        part.graph.neighbours.push_back(other);
        part.graph.edge_weights.push_back(weight);
      }
    });
    part.graph.offsets.push_back(static_cast<std::int64_t>(part.graph.neighbours.size()));
  }
  return part;
}

/// Connected components restricted to nodes of equal `label`, numbered in order of their smallest nodes.
struct labelled_components {
  std::vector<local_id> of_node; ///< the component of each node
  local_id count = 0;            ///< how many components there are

  using fields = field_list<&labelled_components::of_node, &labelled_components::count>;
};

/// Components of the graph when only edges between nodes of the same label count. Linear.
template <graph G>
labelled_components components_within(const G& graph, std::span<const local_id> label) {
  labelled_components found;
  found.of_node.assign(label.size(), no_id);
  std::vector<local_id> stack;
  for (std::size_t seed = 0; seed < label.size(); ++seed) {
    if (found.of_node[seed] != no_id)
      continue;
    const local_id component = found.count++;
    found.of_node[seed] = component;
    stack.push_back(static_cast<local_id>(seed));
    while (!stack.empty()) {
      const local_id v = stack.back();
      stack.pop_back();
      graph.for_each_neighbour(v, [&](local_id w) {
        if (found.of_node[w] != no_id || label[w] != label[v])
          return;
        found.of_node[w] = component;
        stack.push_back(w);
      });
    }
  }
  return found;
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/graph/contraction.ipp"
#endif
