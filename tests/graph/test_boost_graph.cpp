#include "dovetail/graph/boost_graph.hpp"
#include "dovetail/graph/breadth_first.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "support/jittered_meshes.hpp"

#include <boost/graph/connected_components.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/kruskal_min_spanning_tree.hpp>
#include <doctest/doctest.h>

#include <iterator>
#include <vector>

using namespace dovetail;

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
  const csr_graph graph = make_csr_graph(boost_view(list, weights));
  CHECK(graph.node_weights == weights);
  CHECK(graph.edge_weights == std::vector<double>(12, 2.5));
}

TEST_CASE("a partitioner takes a Boost graph in one line") {
  const auto list = to_boost(random_graph());
  const csr_graph graph = make_csr_graph(boost_view(list));
  const auto part = partition::greedy{}(graph, 4);
  CHECK(imbalance_of(graph, part, 4) < 1.1);
}

TEST_CASE("a graph comes back from Boost as it was") {
  const csr_graph graph = random_graph();
  const weighted_adjacency_list copy = to_boost(graph);
  const csr_graph back = make_csr_graph(boost_view(copy));
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
    graph.for_each_edge(v, [&](local_id w, double weight) {
      CHECK(distance[static_cast<std::size_t>(w)] <= distance[static_cast<std::size_t>(v)] + weight);
    });
}
