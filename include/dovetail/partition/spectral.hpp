/// @file
/// Adapter: recursive spectral bisection, with Eigen's eigensolver at the bottom.
#pragma once

#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/finishing.hpp"
#include "dovetail/partition/recursive_bisection.hpp"
#include "dovetail/partition/spectral_fiedler.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dovetail::partition {

/// Cuts at the weighted median of the Fiedler vector, again and again (A. Pothen, H. D. Simon and K.-P. Liou,
/// "Partitioning sparse matrices with eigenvectors of graphs", 1990), and refines by single moves: each
/// bisection and, at the end, all parts together. Edge weights count as conductances.
struct spectral {
  double imbalance = 1.03;   ///< heaviest part over average part
  int refinement_passes = 8; ///< of single moves that shrink the cut; 0: the eigenvector alone decides
  std::uint64_t seed = 1;    ///< of the order in which nodes are matched
  double tolerance = 3e-3;   ///< relative residual of the eigenvector

  /// The part in [0, parts) of every node. Throws `partition_error` when there are fewer nodes than parts.
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    detail::require_partitionable(graph, parts);
    detail::require_imbalance(imbalance);
    const auto by_fiedler_vector = [this](const csr_graph& piece, int left, int right) {
      return bisect(piece, left, right);
    };
    std::vector<local_id> part = recursive_bisection(graph, parts, by_fiedler_vector);
    detail::finish_partition(graph, part, parts, imbalance, refinement_passes);
    return part;
  }

private:
  std::vector<local_id> bisect(const csr_graph& graph, int left, int right) const {
    const std::vector<int> shares{left, right};
    auto half = cut_order(order_to_cut(graph, left, right), graph.node_weights, shares);
    if (refinement_passes > 0) {
      const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
      const double share = imbalance * total / (left + right);
      partition_refiner(graph, half, {share * left, share * right}).refine(refinement_passes);
    }
    return half;
  }

  /// Components one after the other; the one that is cut is ordered by its Fiedler vector.
  std::vector<local_id> order_to_cut(const csr_graph& graph, int left, int right) const {
    const std::vector<local_id> alike(graph.node_weights.size(), 0);
    const labelled_components components = components_within(graph, alike);
    const auto weights = part_weights(graph, components.of_node, components.count);
    const double target =
        std::accumulate(weights.begin(), weights.end(), 0.0) * left / static_cast<double>(left + right);
    std::size_t cut_one = 0;
    for (double before = weights[0]; cut_one + 1 < weights.size() && before < target;)
      before += weights[++cut_one];
    std::vector<double> keys(components.of_node.begin(), components.of_node.end());
    const subgraph piece = induced_subgraph(graph, components.of_node, static_cast<local_id>(cut_one));
    if (piece.nodes.size() > 2)
      spread_over_unit(fiedler_of(piece.graph), piece.nodes, keys);
    return order_by(keys);
  }

  std::vector<double> fiedler_of(const csr_graph& graph) const {
    return detail::fiedler_solver({.seed = seed, .tolerance = tolerance})(graph);
  }

  /// Adds values in (-1/2, 1/2), in the same order as the given ones, to the keys of the nodes.
  static void spread_over_unit(const std::vector<double>& values, const std::vector<local_id>& nodes,
                               std::vector<double>& keys) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double width = std::max(*most - *least, 1e-300);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      keys[static_cast<std::size_t>(nodes[k])] += 0.9 * ((values[k] - *least) / width - 0.5);
  }
};

static_assert(graph_partitioner<spectral>);

} // namespace dovetail::partition
