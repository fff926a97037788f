#include "dovetail/partition/coarsening.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/refinement.hpp"
#include "partition/partitioner_contract.hpp"

using namespace dovetail;

TEST_CASE("greedy with a looser limit keeps to it") {
  const csr_graph graph = dovetail_test::element_graph(dovetail_test::jittered_cubes(6), 9);
  const partition::greedy loose{.imbalance = 1.2};
  dovetail_test::check_partition(graph, loose(graph, 10), 10, 1.2);
}

TEST_CASE("fewer than two coarse nodes per part are refused: a part might get none") {
  std::vector<weighted_edge> edges;
  for (local_id v = 0; v < 6; ++v)
    for (local_id w = v + 1; w < 6; ++w)
      edges.push_back({v, w, 1});
  const csr_graph complete = make_csr_graph(std::vector<double>(6, 1), edges);
  for (const int nodes : {-1, 0, 1})
    CHECK_THROWS_WITH_AS((partition::greedy{.coarse_nodes_per_part = nodes}(complete, 4)),
                         doctest::Contains("give 2 or more"), partition_error);
  dovetail_test::check_partition(complete, partition::greedy{.coarse_nodes_per_part = 2}(complete, 4), 4, 2);
}

TEST_CASE("refinement never makes the cut worse and finds the obvious move") {
  dovetail_test::random_numbers random(4);
  const csr_graph graph = dovetail_test::element_graph(dovetail_test::jittered_cubes(5), 2);
  std::vector<local_id> part(graph.node_weights.size());
  for (std::size_t v = 0; v < part.size(); ++v)
    part[v] = static_cast<local_id>(v * 4 / part.size());
  for (int k = 0; k < 100; ++k)
    part[random.bits() % part.size()] = static_cast<local_id>(random.bits() % 4);
  const double before = edge_cut(graph, part);
  partition_refiner(graph, part, equal_limits(graph, 4, 1.1)).refine();
  CHECK(edge_cut(graph, part) < 0.8 * before);
  CHECK(imbalance_of(graph, part, 4) <= 1.1);
}

TEST_CASE("matching halves a mesh's graph and keeps its weight") {
  const csr_graph graph = dovetail_test::element_graph(dovetail_test::jittered_cubes(6));
  const auto coarse = match_heavy_edges(graph, 1e9, 1);
  CHECK(coarse.graph.node_count() < graph.node_count() * 6 / 10);
  CHECK(std::accumulate(coarse.graph.node_weights.begin(), coarse.graph.node_weights.end(), 0.0) ==
        doctest::Approx(graph.node_count()));
}
