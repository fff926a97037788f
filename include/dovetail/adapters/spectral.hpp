/// @file
/// Adapter: multilevel recursive spectral bisection, with Spectra's eigensolver and Eigen's sparse Cholesky
/// decomposition.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/multilevel.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "dovetail/partition/recursive_bisection.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace dovetail {

namespace detail {

/// The inverse of the Laplacian L of a connected graph, as M^1/2 (L + epsilon M)^-1 M^1/2, for Spectra.
/// Masses M are the node weights, but none is zero, so that light nodes go with their neighbours.
class inverse_laplacian {
public:
  using Scalar = double; // NOLINT: the name is Spectra's

  explicit inverse_laplacian(const csr_graph& graph) : scale_(graph.node_count()) {
    constexpr double epsilon = 1e-9; // of the largest entry: L itself has the eigenvalue 0
    const auto n = static_cast<Eigen::Index>(graph.node_count());
    const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
    const double least = total > 0 ? 1e-3 * total / static_cast<double>(n) : 1.0;
    for (Eigen::Index v = 0; v < n; ++v)
      scale_[v] = 1 / std::sqrt(std::max(least, graph.node_weights[v]));
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);
    for (Eigen::Index v = 0; v < n; ++v)
      for (std::int64_t k = graph.offsets[v]; k < graph.offsets[static_cast<std::size_t>(v) + 1]; ++k) {
        const Eigen::Index w = graph.neighbours[k];
        const double weight = graph.edge_weights[k] * scale_[v];
        diagonal[v] += weight * scale_[v];
        entries.emplace_back(v, w, -weight * scale_[w]);
      }
    for (Eigen::Index v = 0; v < n; ++v)
      entries.emplace_back(v, v, diagonal[v] + epsilon * diagonal.maxCoeff());
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(matrix);
  }

  Eigen::Index rows() const { return scale_.size(); }
  Eigen::Index cols() const { return scale_.size(); }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, rows()) = factors_.solve(Eigen::Map<const Eigen::VectorXd>(in, rows()));
  }
  const Eigen::VectorXd& scale() const { return scale_; }

private:
  Eigen::VectorXd scale_; ///< M^-1/2
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

/// The Fiedler vector of a connected graph of three nodes or more: the eigenvector of the second smallest
/// eigenvalue of L x = lambda M x, which varies as little as possible along the edges (M. Fiedler, 1973).
/// Throws `partition_error` when the eigensolver does not converge.
inline std::vector<double> fiedler_vector(const csr_graph& graph) {
  constexpr int pairs = 2; // the constant vector has the smallest eigenvalue
  inverse_laplacian inverse(graph);
  Spectra::SymEigsSolver<inverse_laplacian> solver(inverse, pairs, std::min(graph.node_count(), 20));
  solver.init();
  if (solver.compute(Spectra::SortRule::LargestAlge, 1000, 1e-6) < pairs)
    throw partition_error("spectral: the eigenvectors of a graph of " + std::to_string(graph.node_count()) +
                          " nodes do not converge; take another partitioner");
  const Eigen::VectorXd x = inverse.scale().cwiseProduct(solver.eigenvectors().col(1));
  return {x.data(), x.data() + x.size()};
}

} // namespace detail

namespace partition {

/// Contracts the graph along heavy edges, cuts the small one at the weighted median of its Fiedler vector,
/// again and again (A. Pothen, H. D. Simon and K.-P. Liou, "Partitioning sparse matrices with eigenvectors of
/// graphs", 1990), and refines by single moves on the way back. Edge weights count as conductances.
struct spectral {
  double imbalance = 1.03; ///< heaviest part over average part
  /// On each level; 0: the eigenvectors of the whole graph alone decide, which takes minutes for large ones.
  int refinement_passes = 8;
  std::uint64_t seed = 1; ///< of the order in which nodes are matched
  int coarse_nodes_per_part =
      100; ///< coarsening stops there; eigenvectors are those of the graph that is left

  /// The part in [0, parts) of every node. Throws `partition_error` when there are fewer nodes than parts.
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    detail::require_partitionable(graph, parts);
    detail::require_imbalance(imbalance);
    const multilevel_options options{.imbalance = imbalance,
                                     .seed = seed,
                                     .coarse_nodes_per_part =
                                         refinement_passes > 0 ? coarse_nodes_per_part : graph.node_count(),
                                     .refinement_passes = refinement_passes};
    return partition_by_levels(graph, parts, options, [this](const csr_graph& small, int all) {
      return recursive_bisection(small, all, [this](const csr_graph& part, int left, int right) {
        return bisect(part, left, right);
      });
    });
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
    const subgraph part = induced_subgraph(graph, components.of_node, static_cast<local_id>(cut_one));
    if (part.nodes.size() > 2)
      spread_over_unit(detail::fiedler_vector(part.graph), part.nodes, keys);
    return order_by(keys);
  }

  /// Adds values in (-1/2, 1/2), in the same order as the given ones, to the keys of the nodes.
  static void spread_over_unit(const std::vector<double>& values, const std::vector<local_id>& nodes,
                               std::vector<double>& keys) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double width = std::max(*most - *least, 1e-300);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      keys[nodes[k]] += 0.9 * ((values[k] - *least) / width - 0.5);
  }
};

static_assert(graph_partitioner<spectral>);

} // namespace partition
} // namespace dovetail
