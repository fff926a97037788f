#include "dovetail/adapters/boost_graph.hpp"
#include "dovetail/graph/breadth_first.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/inertial.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "dovetail/partition/space_filling_curve.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "support/jittered_meshes.hpp"

#include <boost/graph/connected_components.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/grid_graph.hpp>
#include <boost/graph/kruskal_min_spanning_tree.hpp>
#include <doctest/doctest.h>

#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

using namespace dovetail;

template <>
inline constexpr bool dovetail::is_symmetric_boost_graph<boost::grid_graph<2>> = true;

namespace {

using plain_list = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
static_assert(weighted_graph<boost_view<plain_list>> && weighted_graph<boost_view<weighted_adjacency_list>>);

// Edges that lead one way, and what would be gone, are refused.
template <class G>
concept viewable = requires {
  typename boost_view<G>;
};
using one_way_list = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;
static_assert(viewable<plain_list> && !viewable<one_way_list>);
static_assert(std::is_constructible_v<boost_view<plain_list>, const plain_list&> &&
              !std::is_constructible_v<boost_view<plain_list>, plain_list>);

/// A square 0 1 2 3 with one diagonal, and an edge 4 5 by itself.
template <class List, class... Weight>
List square(Weight... weight) {
  List list(6);
  for (const auto& [a, b] : {std::pair(0U, 1U), {1U, 2U}, {2U, 3U}, {3U, 0U}, {0U, 2U}, {4U, 5U}})
    boost::add_edge(a, b, typename List::edge_property_type(weight...), list);
  return list;
}

csr_graph random_graph() {
  dovetail_test::random_numbers random(3);
  std::vector<weighted_edge> edges;
  for (int k = 0; k < 120; ++k)
    edges.push_back({static_cast<local_id>(random.bits() % 50), static_cast<local_id>(random.bits() % 50),
                     static_cast<double>(1 + random.bits() % 9)});
  return make_csr_graph(std::vector<double>(50, 1.0), edges);
}

} // namespace

TEST_CASE("the algorithms run on a Boost graph") {
  const auto list = square<plain_list>();
  const boost_view view(list);
  const std::vector<local_id> one(6, 0);
  CHECK(components_within(view, one).of_node == std::vector<local_id>{0, 0, 0, 0, 1, 1});
  CHECK(breadth_first_order(view, 1) == std::vector<local_id>{1, 0, 2, 3});
  const std::vector<local_id> halves{0, 0, 1, 1, 1, 1};
  const csr_graph cut = contract(view, halves, 2);
  CHECK(cut.node_weights == std::vector<double>{2, 4});
  CHECK(cut.edge_weights == std::vector<double>{3, 3});
  CHECK(induced_subgraph(view, halves, 1).graph.neighbours == std::vector<local_id>{1, 0, 3, 2});
}

TEST_CASE("weights of a Boost graph are its property and what is given") {
  const auto list = square<weighted_adjacency_list>(2.5);
  const std::vector<double> weights{1, 2, 3, 4, 5, 6};
  const csr_graph graph = csr_graph(boost_view(list, weights));
  CHECK(graph.node_weights == weights);
  CHECK(graph.edge_weights == std::vector<double>(12, 2.5));
}

TEST_CASE("every partitioner takes a Boost graph as it is, and makes the same of it as of its copy in rows") {
  const auto list = to_boost(random_graph());
  std::vector<vec3> places;
  for (int v = 0; v < 50; ++v)
    places.push_back({std::cos(0.1 * v), std::sin(0.1 * v), 0.01 * v});
  const boost_view network(list, {}, places);
  const csr_graph rows = network;
  CHECK(rows.positions == places);
  const auto check = [&](const auto& partitioner) {
    const std::vector<local_id> part = partitioner(network, 4);
    CHECK(part == partitioner(rows, 4));
    CHECK(imbalance_of(network, part, 4) < 1.1);
    CHECK(imbalance_of(network, part, 4) == imbalance_of(rows, part, 4));
    CHECK(edge_cut(network, part) == edge_cut(rows, part));
  };
  check(partition::greedy{});
  check(partition::inertial{});
  check(partition::recursive_coordinate{});
  check(partition::space_filling_curve{});
  check(any_partitioner(partition::greedy{}));
  check([](const csr_graph& graph, int parts) { return partition::greedy{}(graph, parts); });
}

TEST_CASE("parallel edges of a Boost graph add up, and self loops count for nothing") {
  weighted_adjacency_list list(3);
  for (const auto& [a, b, weight] :
       {std::tuple(0U, 1U, 0.1), {1U, 0U, 0.2}, {1U, 1U, 9.0}, {2U, 1U, 0.3}, {0U, 1U, 0.3}})
    boost::add_edge(a, b, weight, list);
  const csr_graph graph = boost_view(list);
  CHECK(graph.offsets == std::vector<std::int64_t>{0, 1, 3, 4});
  CHECK(graph.neighbours == std::vector<local_id>{1, 0, 2, 1});
  CHECK(graph.edge_weights[0] == doctest::Approx(0.6));
  CHECK(graph.edge_weights[0] == graph.edge_weights[1]); // to the last bit
}

TEST_CASE("weights may be a property of one's own") {
  struct road {
    double lanes = 1;
  };
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property, road> roads(3);
  boost::add_edge(0, 1, road{4}, roads);
  boost::add_edge(1, 2, road{2}, roads);
  CHECK(csr_graph(boost_view(roads)).edge_weights == std::vector<double>{1, 1, 1, 1});
  CHECK(csr_graph(boost_view(roads, get(&road::lanes, roads))).edge_weights ==
        std::vector<double>{4, 4, 2, 2});
}

TEST_CASE("vertices that are no numbers go by their vertex_index") {
  using grid = boost::grid_graph<2>;
  const grid squares(boost::array<std::size_t, 2>{{8, 8}});
  const boost_view view(squares);
  static_assert(weighted_graph<boost_view<grid>>);
  const auto part = partition::greedy{}(view, 4);
  CHECK(imbalance_of(view, part, 4) < 1.1);
  CHECK(edge_cut(view, part) < 30);

  using chained = boost::adjacency_list<boost::listS, boost::listS, boost::undirectedS,
                                        boost::property<boost::vertex_index_t, std::size_t>>;
  chained path;
  std::vector<chained::vertex_descriptor> nodes;
  for (std::size_t v = 0; v < 4; ++v)
    nodes.push_back(boost::add_vertex(3 - v, path));
  boost::add_edge(nodes[0], nodes[1], path);
  boost::add_edge(nodes[1], nodes[3], path);
  CHECK(csr_graph(boost_view(path)).neighbours == std::vector<local_id>{2, 0, 3, 2});
}

namespace {

/// Edges of little capacity are not cut: they are contracted, those of the least first.
struct narrow_edges {
  double wanted = 4;

  template <weighted_graph G>
  side_judgement operator()(const G&, const graph_dual& edges) const {
    side_judgement judged{{}, wanted, 0};
    for (std::size_t e = 0; e < edges.side_count(); ++e)
      judged.quality.push_back(edges.side_weight(static_cast<local_id>(e)));
    return judged;
  }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return a.side < b.side; }
  double penalty(const deficit&) const { return 10; }
};

} // namespace

TEST_CASE("the contraction keeps the weights of a network's edges") {
  const csr_graph rows = random_graph();
  const auto list = to_boost(rows);
  const boost_view network(list);
  const narrow_edges rule;

  const graph_dual duals(network);
  const auto all = simplify(network, duals, narrow_edges{.wanted = 0});
  CHECK(all.graph.neighbours == rows.neighbours);
  CHECK(all.graph.edge_weights == rows.edge_weights);

  const auto some = simplify(network, duals, rule, {.fraction = 0, .always_allowed_elements = 4});
  REQUIRE(some.super_count < 50);
  REQUIRE(!some.refused.empty());
  csr_graph expected = contract(network, some.super_of_element, some.super_count);
  CHECK(some.graph.neighbours == expected.neighbours);
  CHECK(some.graph.node_weights == expected.node_weights);
  for (const refused_side& each : some.refused) { // each weighs ten times as much
    const auto [a, b] = duals.elements(each.side);
    const local_id from = some.super_of_element[a];
    const local_id to = some.super_of_element[b];
    for (const auto& [x, y] : {std::pair(from, to), {to, from}})
      for (auto k = expected.offsets[x]; k < expected.offsets[static_cast<std::size_t>(x) + 1]; ++k)
        if (expected.neighbours[k] == y)
          expected.edge_weights[k] += 9 * duals.side_weight(each.side);
  }
  for (std::size_t k = 0; k < expected.edge_weights.size(); ++k)
    CHECK(some.graph.edge_weights[k] == doctest::Approx(expected.edge_weights[k]));
}

TEST_CASE("an edge whose weight is no number is refused by its number") {
  weighted_adjacency_list list(2);
  boost::add_edge(0, 1, std::nan(""), list);
  const boost_view network(list);
  CHECK_THROWS_WITH_AS(simplify(network, graph_dual(network), narrow_edges{.wanted = 0}),
                       doctest::Contains("side 0"), usage_error);
}

TEST_CASE("a graph comes back from Boost as it was") {
  const csr_graph graph = random_graph();
  const weighted_adjacency_list copy = to_boost(graph);
  const csr_graph back = boost_view(copy);
  CHECK(back.offsets == graph.offsets);
  CHECK(back.neighbours == graph.neighbours);
  CHECK(back.edge_weights == graph.edge_weights);
}

TEST_CASE("Boost's algorithms run on a copy") {
  const csr_graph graph = random_graph();
  const auto list = to_boost(graph);
  std::vector<local_id> component(50);
  const int count = boost::connected_components(list, component.data());
  const auto found = components_within(graph, std::vector<local_id>(50, 0));
  CHECK(count == found.count);
  CHECK(component == found.of_node);
  std::vector<weighted_adjacency_list::edge_descriptor> tree;
  boost::kruskal_minimum_spanning_tree(list, std::back_inserter(tree));
  CHECK(static_cast<int>(tree.size()) + count == 50);
  std::vector<double> distance(50);
  boost::dijkstra_shortest_paths(list, 0, boost::distance_map(distance.data()));
  for (local_id v = 0; v < 50; ++v)
    graph.for_each_edge(v, [&](local_id w, double weight) { CHECK(distance[w] <= distance[v] + weight); });
}
