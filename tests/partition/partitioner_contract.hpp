/// @file
/// What every graph_partitioner has to satisfy; each model's test calls it.
#pragma once

#include "dovetail/graph/contraction.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/partition/concepts.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

namespace dovetail_test {

/// The element graph of a mesh, with node and edge weights at random when `seed` is not 0.
template <int D>
dovetail::csr_graph element_graph(const dovetail::simplicial_mesh<D>& mesh, std::uint64_t seed = 0) {
  const auto sides = dovetail::build_sides(mesh);
  random_numbers random(seed);
  std::vector<double> weights(mesh.elements.size(), 1.0);
  if (seed != 0)
    for (double& w : weights)
      w = 0.2 + 5 * random.unit() * random.unit();
  std::vector<dovetail::weighted_edge> edges;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_interior(static_cast<dovetail::local_id>(s)))
      edges.push_back({sides.elements[s][0], sides.elements[s][1], seed == 0 ? 1.0 : 0.5 + random.unit()});
  dovetail::csr_graph graph = dovetail::make_csr_graph(std::move(weights), edges);
  for (const auto& element : mesh.elements) {
    dovetail::vec3 center;
    for (const auto v : element)
      center += mesh.points[v] / (D + 1.0);
    graph.positions.push_back(center);
  }
  return graph;
}

/// A graph whose nodes stand at equal distances on a circle.
inline dovetail::csr_graph graph_on_circle(std::vector<double> weights,
                                           const std::vector<dovetail::weighted_edge>& edges) {
  dovetail::csr_graph graph = dovetail::make_csr_graph(std::move(weights), edges);
  const double turn = 2 * 3.14159265358979 / std::max(1, graph.node_count());
  for (int v = 0; v < graph.node_count(); ++v)
    graph.positions.push_back({std::cos(v * turn), std::sin(v * turn), 0});
  return graph;
}

/// Two graphs side by side, without an edge between them.
inline dovetail::csr_graph side_by_side(const dovetail::csr_graph& a, const dovetail::csr_graph& b) {
  dovetail::csr_graph both = a;
  for (std::size_t k = 1; k < b.offsets.size(); ++k)
    both.offsets.push_back(a.offsets.back() + b.offsets[k]);
  for (const auto w : b.neighbours)
    both.neighbours.push_back(a.node_count() + w);
  both.edge_weights.insert(both.edge_weights.end(), b.edge_weights.begin(), b.edge_weights.end());
  both.node_weights.insert(both.node_weights.end(), b.node_weights.begin(), b.node_weights.end());
  for (const auto& p : b.positions)
    both.positions.push_back(p + dovetail::vec3{5, 0, 0});
  return both;
}

inline void check_partition(const dovetail::csr_graph& graph, const std::vector<dovetail::local_id>& part,
                            int parts, double imbalance) {
  REQUIRE(part.size() == graph.node_weights.size());
  for (const auto p : part)
    REQUIRE((p >= 0 && p < parts));
  CHECK(std::set<dovetail::local_id>(part.begin(), part.end()).size() == static_cast<std::size_t>(parts));
  const auto weights = dovetail::part_weights(graph, part, parts);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double heaviest_node = *std::max_element(graph.node_weights.begin(), graph.node_weights.end());
  const double allowed = std::max(imbalance * total / parts, total / parts + heaviest_node);
  CHECK(*std::max_element(weights.begin(), weights.end()) <= allowed * (1 + 1e-12));
}

/// `looks_at_edges`: the partitioner chooses its cuts by edge weights, not only by places.
template <dovetail::graph_partitioner Partitioner>
void check_partitioner_contract(const Partitioner& partitioner, double imbalance,
                                bool looks_at_edges = true) {
  using dovetail::csr_graph;
  using dovetail::local_id;
  using dovetail::make_csr_graph;
  using dovetail::weighted_edge;

  SUBCASE("meshes: range, no empty part, balance, repeatable") {
    for (const int parts : {1, 2, 3, 7, 16, 32})
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        CAPTURE(parts);
        CAPTURE(seed);
        const csr_graph cubes = element_graph(jittered_cubes(8), seed);
        const auto part = partitioner(cubes, parts);
        check_partition(cubes, part, parts, imbalance);
        CHECK(partitioner(cubes, parts) == part);
        const csr_graph squares = element_graph(jittered_squares(20), seed);
        check_partition(squares, partitioner(squares, parts), parts, imbalance);
      }
  }
  SUBCASE("the tolerance asked for, tight and loose, is kept or refused") {
    const csr_graph cubes = element_graph(jittered_cubes(8), 1);
    for (const double asked : {1.002, 1.01, 1.1, 1.5}) {
      CAPTURE(asked);
      Partitioner partition_it = partitioner;
      partition_it.imbalance = asked;
      try {
        check_partition(cubes, partition_it(cubes, 6), 6, asked);
      } catch (const dovetail::partition_error& refused) {
        MESSAGE(refused.what());
        CHECK(asked < 1.05); // what is easy must be done
      }
    }
  }
  SUBCASE("a cut of a cube in two is close to the best one") {
    const csr_graph cube = element_graph(jittered_cubes(8));
    const auto part = partitioner(cube, 2);
    CHECK(dovetail::edge_cut(cube, part) <= 1.5 * 2 * 8 * 8); // a plane cuts two triangles per cell
  }
  SUBCASE("heavy edges are avoided") {
    // Rings of 12 nodes with two cheap edges, opposite each other; in every place, lest one be hit by chance.
    for (local_id cheap = 0; cheap < 6; ++cheap) {
      CAPTURE(cheap);
      std::vector<weighted_edge> ring;
      for (local_id v = 0; v < 12; ++v)
        ring.push_back({v, (v + 1) % 12, v % 6 == cheap ? 1.0 : 1000.0});
      const csr_graph graph = graph_on_circle(std::vector<double>(12, 1.0), ring);
      const auto part = partitioner(graph, 2);
      check_partition(graph, part, 2, imbalance);
      if (looks_at_edges)
        CHECK(dovetail::edge_cut(graph, part) == 2);
    }
  }
  SUBCASE("as many parts as nodes, single nodes, no edges") {
    const csr_graph graph = element_graph(jittered_squares(3), 5);
    const int all = graph.node_count();
    check_partition(graph, partitioner(graph, all), all, imbalance);
    check_partition(graph, partitioner(graph, all - 1), all - 1, imbalance);
    const csr_graph single = graph_on_circle({3.0}, {});
    CHECK(partitioner(single, 1) == std::vector<local_id>{0});
    const csr_graph loose = graph_on_circle(std::vector<double>(50, 1.0), {});
    check_partition(loose, partitioner(loose, 7), 7, imbalance);
  }
  SUBCASE("one node much heavier than the rest") {
    csr_graph graph = element_graph(jittered_cubes(4));
    graph.node_weights[100] = 500;
    check_partition(graph, partitioner(graph, 8), 8, imbalance);
  }
  SUBCASE("several heavy nodes") {
    csr_graph graph = element_graph(jittered_cubes(4), 2);
    for (std::size_t v = 0; v < graph.node_weights.size(); v += 50)
      graph.node_weights[v] = 60;
    check_partition(graph, partitioner(graph, 5), 5, imbalance);
  }
  SUBCASE("nodes without weight, some or all of them") {
    csr_graph graph = element_graph(jittered_cubes(5));
    for (std::size_t v = 0; v < graph.node_weights.size(); v += 3)
      graph.node_weights[v] = 0;
    check_partition(graph, partitioner(graph, 8), 8, imbalance);
    std::fill(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
    check_partition(graph, partitioner(graph, 8), 8, imbalance);
  }
  SUBCASE("a graph in pieces") {
    const csr_graph block = element_graph(jittered_cubes(4), 4);
    const csr_graph two = side_by_side(block, element_graph(jittered_cubes(3), 6));
    const csr_graph three = side_by_side(two, graph_on_circle({1, 2, 3}, {{0, 1, 1}}));
    for (const int parts : {2, 3, 8}) {
      check_partition(two, partitioner(two, parts), parts, imbalance);
      check_partition(three, partitioner(three, parts), parts, imbalance);
    }
  }
  SUBCASE("weights of any magnitude") {
    for (const double scale : {1e-9, 1e12}) {
      csr_graph graph = element_graph(jittered_cubes(5), 3);
      for (double& w : graph.node_weights)
        w *= scale;
      for (double& w : graph.edge_weights)
        w *= scale;
      check_partition(graph, partitioner(graph, 8), 8, imbalance);
    }
  }
  SUBCASE("what cannot be done is a typed error") {
    const csr_graph graph = element_graph(jittered_squares(2));
    CHECK_THROWS_AS(partitioner(graph, 0), dovetail::partition_error);
    CHECK_THROWS_AS(partitioner(graph, 9), dovetail::partition_error);
    Partitioner impossible = partitioner;
    impossible.imbalance = 0.9;
    CHECK_THROWS_WITH_AS(impossible(graph, 2), doctest::Contains("imbalance"), dovetail::partition_error);
    csr_graph broken = graph;
    broken.node_weights[1] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(partitioner(broken, 2), doctest::Contains("node 1"), dovetail::partition_error);
  }
}

} // namespace dovetail_test
