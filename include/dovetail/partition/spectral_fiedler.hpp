/// @file
/// The Fiedler vector of a weighted graph: the eigenvector of the second smallest eigenvalue of its
/// Laplacian, which varies as little as possible along the edges (M. Fiedler, 1973).
///
/// Multilevel, as in S. T. Barnard and H. D. Simon, "Fast multilevel implementation of recursive spectral
/// bisection" (1994): a dense eigenproblem on a graph contracted along heavy edges, then on each finer graph
/// a few steps of A. V. Knyazev's LOBPCG (2001) for one vector, with the diagonal as preconditioner.
#pragma once

#include "dovetail/partition/coarsening.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// Finds the Fiedler vector of a connected graph with at least two nodes.
class fiedler_solver {
public:
  struct parameters {
    std::uint64_t seed = 1;
    int dense_nodes = 100;   ///< the size of the dense eigenproblem
    int largest_steps = 60;  ///< per level
    double tolerance = 3e-3; ///< relative residual at which a level is done
  };

  explicit fiedler_solver(const parameters& p) : parameters_(p) {}

  std::vector<double> operator()(const csr_graph& graph) const {
    const std::vector<coarsened_graph> levels = coarsen(graph);
    Eigen::VectorXd x = dense_solution(levels.empty() ? graph : levels.back().graph);
    for (std::size_t level = levels.size(); level-- > 0;) {
      const csr_graph& finer = level == 0 ? graph : levels[level - 1].graph;
      Eigen::VectorXd interpolated(finer.node_count());
      for (Eigen::Index v = 0; v < interpolated.size(); ++v)
        interpolated[v] = x[levels[level].node_of[static_cast<std::size_t>(v)]];
      x = std::move(interpolated);
      improve(finer, x);
    }
    return {x.data(), x.data() + x.size()};
  }

private:
  /// Masses of the generalised problem L x = lambda M x: node weights, but none is zero, so that light nodes
  /// go with their neighbours.
  static Eigen::VectorXd masses(const csr_graph& graph) {
    Eigen::VectorXd m(graph.node_count());
    const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
    const double least = total > 0 ? 1e-3 * total / graph.node_count() : 1.0;
    for (Eigen::Index v = 0; v < m.size(); ++v)
      m[v] = std::max(least, graph.node_weights[static_cast<std::size_t>(v)]);
    return m;
  }

  static Eigen::VectorXd degrees(const csr_graph& graph) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(graph.node_count());
    for (Eigen::Index v = 0; v < d.size(); ++v)
      for (std::int64_t k = graph.offsets[static_cast<std::size_t>(v)];
           k < graph.offsets[static_cast<std::size_t>(v) + 1]; ++k)
        d[v] += graph.edge_weights[static_cast<std::size_t>(k)];
    return d;
  }

  static Eigen::VectorXd laplacian_times(const csr_graph& graph, const Eigen::VectorXd& d,
                                         const Eigen::VectorXd& x) {
    Eigen::VectorXd y(x.size());
    for (Eigen::Index v = 0; v < x.size(); ++v) {
      double sum = d[v] * x[v];
      for (std::int64_t k = graph.offsets[static_cast<std::size_t>(v)];
           k < graph.offsets[static_cast<std::size_t>(v) + 1]; ++k)
        sum -= graph.edge_weights[static_cast<std::size_t>(k)] *
               x[graph.neighbours[static_cast<std::size_t>(k)]];
      y[v] = sum;
    }
    return y;
  }

  std::vector<coarsened_graph> coarsen(const csr_graph& graph) const {
    const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
    std::vector<coarsened_graph> levels;
    while (true) {
      const csr_graph& finer = levels.empty() ? graph : levels.back().graph;
      if (finer.node_count() <= parameters_.dense_nodes)
        break;
      coarsened_graph coarser = match_heavy_edges(finer, total, parameters_.seed + levels.size());
      if (coarser.graph.node_count() == finer.node_count())
        break; // a star, say: its hub has one mate per level, but an edge is always matched
      levels.push_back(std::move(coarser));
    }
    return levels;
  }

  /// The whole spectrum of M^-1/2 L M^-1/2; the eigenvector after the constant one.
  Eigen::VectorXd dense_solution(const csr_graph& graph) const {
    const Eigen::Index n = graph.node_count();
    const Eigen::VectorXd scale = masses(graph).cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index v = 0; v < n; ++v)
      for (std::int64_t k = graph.offsets[static_cast<std::size_t>(v)];
           k < graph.offsets[static_cast<std::size_t>(v) + 1]; ++k) {
        const Eigen::Index w = graph.neighbours[static_cast<std::size_t>(k)];
        const double weight = graph.edge_weights[static_cast<std::size_t>(k)];
        matrix(v, w) -= weight * scale[v] * scale[w];
        matrix(v, v) += weight * scale[v] * scale[v];
      }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
    return scale.cwiseProduct(solver.eigenvectors().col(1));
  }

  /// A vector with its image under the Laplacian, so that each step multiplies only once.
  struct direction {
    Eigen::VectorXd vector;
    Eigen::VectorXd image;

    void add(double factor, const direction& other) {
      vector += factor * other.vector;
      image += factor * other.image;
    }
    void scale(double factor) {
      vector *= factor;
      image *= factor;
    }
  };

  static double product(const Eigen::VectorXd& mass, const direction& a, const direction& b) {
    return a.vector.dot(mass.cwiseProduct(b.vector));
  }
  /// Makes a vector orthogonal to the constant one, whose image is zero.
  static void remove_constant(const Eigen::VectorXd& mass, direction& d) {
    d.vector.array() -= mass.dot(d.vector) / mass.sum();
  }

  /// LOBPCG: minimises the Rayleigh quotient over the span of x, the preconditioned residual and the step
  /// before, again and again.
  void improve(const csr_graph& graph, Eigen::VectorXd& start) const {
    const Eigen::VectorXd mass = masses(graph);
    const Eigen::VectorXd degree = degrees(graph);
    direction x{std::move(start), {}};
    remove_constant(mass, x);
    x.image = laplacian_times(graph, degree, x.vector);
    x.scale(1 / std::sqrt(product(mass, x, x)));
    direction step; // empty at first
    for (int k = 0; k < parameters_.largest_steps; ++k) {
      const double quotient = x.vector.dot(x.image);
      Eigen::VectorXd residual = x.image - quotient * mass.cwiseProduct(x.vector);
      if (residual.norm() <= parameters_.tolerance * x.image.norm())
        break;
      direction descent{residual.cwiseQuotient(degree.cwiseMax(1e-300)), {}};
      remove_constant(mass, descent);
      descent.image = laplacian_times(graph, degree, descent.vector);
      std::vector<direction> basis{x};
      append(mass, std::move(descent), basis);
      if (step.vector.size() > 0)
        append(mass, std::move(step), basis);
      if (basis.size() == 1)
        break;
      const Eigen::VectorXd best = smallest_ritz_vector(basis);
      step = std::move(basis[1]);
      step.scale(best[1]);
      if (basis.size() == 3)
        step.add(best[2], basis[2]);
      x.scale(best[0]);
      x.add(1, step);
      remove_constant(mass, x);
      x.scale(1 / std::sqrt(product(mass, x, x)));
    }
    start = std::move(x.vector);
  }

  /// Appends the part of a vector that is M-orthogonal to the basis, unless nothing of it is left.
  static void append(const Eigen::VectorXd& mass, direction d, std::vector<direction>& basis) {
    constexpr double nothing = 1e-12;
    d.scale(1 / std::max(1e-300, std::sqrt(product(mass, d, d))));
    for (int twice = 0; twice < 2; ++twice)
      for (const direction& b : basis)
        d.add(-product(mass, b, d), b);
    const double length = std::sqrt(product(mass, d, d));
    if (length > nothing) {
      d.scale(1 / length);
      basis.push_back(std::move(d));
    }
  }

  static Eigen::VectorXd smallest_ritz_vector(const std::vector<direction>& basis) {
    const auto n = static_cast<Eigen::Index>(basis.size());
    Eigen::MatrixXd small(n, n);
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = 0; i < n; ++i)
        small(i, j) = basis[static_cast<std::size_t>(i)].vector.dot(basis[static_cast<std::size_t>(j)].image);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(small);
    return solver.eigenvectors().col(0);
  }

  parameters parameters_;
};

} // namespace dovetail::detail
