#include "dovetail/adapters/spectral.hpp"
#include "partition/partitioner_contract.hpp"

#include <numbers>

using namespace dovetail;

TEST_CASE("spectral bisection satisfies the partitioner contract") {
  dovetail_test::check_partitioner_contract(partition::spectral{}, 1.03);
}

TEST_CASE("spectral bisection without refinement satisfies it too") {
  dovetail_test::check_partitioner_contract(partition::spectral{.refinement_passes = 0}, 1.03);
}

TEST_CASE("the Fiedler vector of a path is a half wave") {
  constexpr int nodes = 1000;
  std::vector<weighted_edge> path;
  for (local_id v = 0; v + 1 < nodes; ++v)
    path.push_back({v, v + 1, 1});
  const csr_graph graph = make_csr_graph(std::vector<double>(nodes, 1.0), path);
  const auto x = detail::fiedler_vector(graph);
  double along = 0; // of the unit vectors
  double length = 0;
  for (int v = 0; v < nodes; ++v) {
    const double wave = std::cos(std::numbers::pi * (v + 0.5) / nodes) * std::sqrt(2.0 / nodes);
    along += wave * x[v];
    length += x[v] * x[v];
  }
  CHECK(std::abs(along) / std::sqrt(length) > 0.99999);
}

TEST_CASE("a dumbbell is cut at its handle") {
  const csr_graph ball = dovetail_test::element_graph(dovetail_test::jittered_cubes(5));
  csr_graph both = dovetail_test::side_by_side(ball, ball);
  std::vector<weighted_edge> edges;
  for (local_id v = 0; v < both.node_count(); ++v)
    for (const local_id w : both.row(v))
      if (v < w)
        edges.push_back({v, w, 1});
  edges.push_back({0, ball.node_count(), 1});
  const csr_graph dumbbell = make_csr_graph(both.node_weights, edges);
  CHECK(edge_cut(dumbbell, partition::spectral{.refinement_passes = 0}(dumbbell, 2)) == 1);
}
