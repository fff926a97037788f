/// A Poisson problem on the meshes of several ranks, as a parallel solver has them: each rank assembles its
/// own elements, and what ranks share is added up along the lists of neighbours. Here all ranks are in one
/// process; with MPI `exchange` sends and receives. Compared with the serial solution. Usage:
/// 12_distributed_poisson [RANKS [SIZE]]
#include "dovetail/distributed/by_pieces.hpp"
#include "dovetail/dovetail.hpp"
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/solver/gather.hpp"
#include "linear_elements.hpp"

#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace dovetail;
using vectors = std::vector<Eigen::VectorXd>; ///< per rank: a value per vertex that it holds

struct wave {
  double operator()(const Eigen::Vector3d& x) const { return std::sin(x.dot(Eigen::Vector3d(3, 1, 2))); }
  double source(const Eigen::Vector3d& x) const { return 14 * (*this)(x); }
};

// for the readme
/// Every rank adds what the others have at the vertices that it shares with them.
void exchange(const std::vector<rank_mesh<3>>& ranks, vectors& values) {
  const vectors sent = values;
  for (const auto& rank : ranks)
    for (const auto& here : rank.neighbours) {
      const auto& other = ranks[here.rank];
      const auto there = std::find_if(other.neighbours.begin(), other.neighbours.end(),
                                      [&](const auto& back) { return back.rank == rank.rank; });
      for (std::size_t i = 0; i < here.vertices.size(); ++i) // the same vertices in the same order
        values[rank.rank][here.vertices[i]] += sent[other.rank][there->vertices[i]];
    }
}

/// Each vertex counts once: for its owner.
double dot(const std::vector<rank_mesh<3>>& ranks, const vectors& a, const vectors& b) {
  double sum = 0;
  for (std::size_t q = 0; q < ranks.size(); ++q) {
    const auto owned = static_cast<Eigen::Index>(ranks[q].owned_vertices);
    sum += a[q].head(owned).dot(b[q].head(owned));
  }
  return sum;
}
// end

/// What a rank has of the problem: -laplace(u) = f for the difference of u and its values on the boundary.
struct rank_problem {
  Eigen::SparseMatrix<double> stiffness;
  Eigen::VectorXd load;
  Eigen::VectorXd given; ///< where it is more than 0 a vertex is on the boundary
};

rank_problem assemble(const rank_mesh<3>& rank, const wave& exact) {
  const auto n = static_cast<Eigen::Index>(rank.held_vertices);
  rank_problem problem{{n, n}, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t e = 0; e < rank.owned_elements; ++e) {
    const auto element = element_of(rank.mesh, static_cast<Eigen::Index>(e));
    const auto& vertices = rank.mesh.elements[e];
    for (int i = 0; i < 4; ++i) {
      problem.load[vertices[i]] += element.volume / 4 * exact.source(element.centre);
      for (int j = 0; j < 4; ++j)
        entries.emplace_back(vertices[i], vertices[j],
                             element.volume * element.gradients.col(i).dot(element.gradients.col(j)));
    }
  }
  problem.stiffness.setFromTriplets(entries.begin(), entries.end());
  for (const auto& side : rank.sides) // of one solid: all are on the boundary of the domain
    for (const local_id v : side)
      problem.given[v] = 1;
  return problem;
}

/// Conjugate gradients on all ranks.
vectors solve(const std::vector<rank_mesh<3>>& ranks, const wave& exact) {
  std::vector<rank_problem> problems;
  vectors u, given;
  for (const auto& rank : ranks) {
    problems.push_back(assemble(rank, exact));
    given.push_back(problems.back().given);
  }
  exchange(ranks, given); // a rank may touch the boundary in an edge or a point without having a side there
  for (std::size_t q = 0; q < ranks.size(); ++q) {
    u.push_back(Eigen::VectorXd::Zero(given[q].size()));
    for (Eigen::Index v = 0; v < u[q].size(); ++v)
      if (given[q][v] > 0)
        u[q][v] = exact(as_matrix(ranks[q].mesh.points).row(v));
  }
  const auto apply = [&](const vectors& x) {
    vectors y;
    for (std::size_t q = 0; q < ranks.size(); ++q)
      y.push_back(problems[q].stiffness * x[q]);
    exchange(ranks, y);
    for (std::size_t q = 0; q < ranks.size(); ++q)
      y[q] = (given[q].array() > 0).select(0, y[q]);
    return y;
  };
  vectors residual;
  for (const auto& problem : problems)
    residual.push_back(problem.load);
  exchange(ranks, residual);
  const vectors of_given = apply(u);
  for (std::size_t q = 0; q < ranks.size(); ++q)
    residual[q] = (given[q].array() > 0).select(0, residual[q] - of_given[q]);
  vectors direction = residual;
  double norm = dot(ranks, residual, residual);
  const double enough = 1e-30 * norm;
  for (int step = 0; step < 10000 && norm > enough; ++step) {
    const vectors along = apply(direction);
    const double length = norm / dot(ranks, direction, along);
    const double before = norm;
    for (std::size_t q = 0; q < ranks.size(); ++q) {
      u[q] += length * direction[q];
      residual[q] -= length * along[q];
    }
    norm = dot(ranks, residual, residual);
    for (std::size_t q = 0; q < ranks.size(); ++q)
      direction[q] = residual[q] + norm / before * direction[q];
  }
  return u;
}

} // namespace

int main(int argc, char** argv) try {
  const int count = argc > 1 ? std::atoi(argv[1]) : 4;
  const double size = argc > 2 ? std::atof(argv[2]) : 0.25;
  const implicit_model body(implicit::sphere{}, {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}}, {.resolution = 32});
  const auto result = generate<3>(body, uniform_size(size), parameters<>{}.with_options({.subdomains = 12}));
  const auto given = redistribution_by::pieces{}(result.mesh, count);
  const auto numbers = io::number_by_ranks(result.mesh, given.rank_of_piece, count);
  std::vector<rank_mesh<3>> ranks; // with MPI a rank makes its own
  for (local_id q = 0; q < count; ++q)
    ranks.push_back(io::make_rank_mesh<3>(result.mesh, numbers, q));

  const wave exact;
  const auto u = solve(ranks, exact);
  const auto whole = io::gather(result.mesh);
  const Eigen::VectorXd serial = ::solve(whole.mesh, exact);
  double difference = 0;
  for (std::size_t q = 0; q < ranks.size(); ++q)
    for (std::size_t v = 0; v < ranks[q].held_vertices; ++v)
      difference = std::max(
          difference, std::abs(u[q][static_cast<Eigen::Index>(v)] - serial[ranks[q].vertex_numbers[v]]));
  std::printf("%zu tetrahedra on %d ranks, imbalance %.3f\n", whole.mesh.elements.size(), count,
              given.summary.get("imbalance"));
  std::printf("the largest difference from the serial solution is %.1e: %s\n", difference,
              difference < 1e-10 ? "none but rounding" : "too large");
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
