#include "dovetail/graph/contraction.hpp"
#include "dovetail/graph/csr_boost.hpp"
#include "dovetail/graph/dual.hpp"
#include "dovetail/graph/traversal.hpp"
#include "support/jittered_meshes.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/graph_concepts.hpp>
#include <boost/graph/kruskal_min_spanning_tree.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <doctest/doctest.h>

#include <set>
#include <string>

using namespace dovetail;

using boost_list = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
template <>
inline constexpr bool dovetail::enable_graph<boost_list> = true;

namespace {

template <class G>
void assert_boost_concepts() {
  BOOST_CONCEPT_ASSERT((boost::concepts::IncidenceGraphConcept<G>));
  BOOST_CONCEPT_ASSERT((boost::concepts::AdjacencyGraphConcept<G>));
  BOOST_CONCEPT_ASSERT((boost::concepts::VertexListGraphConcept<G>));
  BOOST_CONCEPT_ASSERT((boost::concepts::EdgeListGraphConcept<G>));
  BOOST_CONCEPT_ASSERT((boost::concepts::ReadablePropertyGraphConcept<G, local_id, boost::vertex_index_t>));
  BOOST_CONCEPT_ASSERT((boost::concepts::ReadablePropertyGraphConcept<G, graph_edge, boost::edge_index_t>));
  static_assert(incidence_graph<G> && adjacency_graph<G> && vertex_list_graph<G> && edge_list_graph<G>);
}

/// Every edge is met once from each end with the same index, and once in the edge list.
template <class G>
void check_rows_against_edges(const G& g) {
  std::multiset<std::pair<std::int64_t, local_id>> from_rows;
  std::multiset<std::pair<std::int64_t, local_id>> from_list;
  for (auto [v, v_end] = vertices(g); v != v_end; ++v) {
    std::size_t degree = 0;
    auto [w, w_end] = adjacent_vertices(*v, g);
    for (auto [e, e_end] = out_edges(*v, g); e != e_end; ++e, ++w, ++degree) {
      REQUIRE(source(*e, g) == *v);
      REQUIRE(target(*e, g) == *w);
      from_rows.insert({get(boost::edge_index, g, *e), *v});
    }
    REQUIRE(w == w_end);
    REQUIRE(degree == out_degree(*v, g));
  }
  for (auto [e, e_end] = edges(g); e != e_end; ++e) {
    from_list.insert({get(boost::edge_index, g, *e), source(*e, g)});
    from_list.insert({get(boost::edge_index, g, *e), target(*e, g)});
  }
  CHECK(from_rows == from_list);
  CHECK(num_edges(g) * 2 == from_rows.size());
}

csr_graph element_graph(const side_table<3>& sides) {
  std::vector<weighted_edge> list;
  const element_dual<3> dual(sides);
  for (auto [e, end] = edges(dual); e != end; ++e)
    list.push_back({e->source, e->target, 1.0 + static_cast<double>(e->index % 7)});
  return make_csr_graph(std::vector<double>(sides.of_element.size(), 1.0), list);
}

} // namespace

TEST_CASE("the graphs satisfy Boost's own concept checks and ours") {
  assert_boost_concepts<csr_graph>();
  assert_boost_concepts<element_dual<2>>();
  assert_boost_concepts<element_dual<3>>();
  assert_boost_concepts<side_dual<2>>();
  assert_boost_concepts<side_dual<3>>();
  BOOST_CONCEPT_ASSERT(
      (boost::concepts::ReadablePropertyGraphConcept<csr_graph, graph_edge, boost::edge_weight_t>));
  static_assert(incidence_graph<boost_list> && vertex_list_graph<boost_list>);
  static_assert(!graph<int> && !graph<std::string> && !incidence_graph<std::vector<int>>);
}

TEST_CASE("rows and edge lists agree") {
  const auto cubes = dovetail_test::shuffled(dovetail_test::jittered_cubes(3), 5);
  const auto squares = dovetail_test::shuffled(dovetail_test::jittered_squares(5), 5);
  const auto sides3 = build_sides(cubes);
  const auto sides2 = build_sides(squares);
  check_rows_against_edges(element_dual<3>(sides3));
  check_rows_against_edges(element_dual<2>(sides2));
  check_rows_against_edges(side_dual<3>(sides3));
  check_rows_against_edges(side_dual<2>(sides2));
  check_rows_against_edges(element_graph(sides3));

  simplicial_mesh<2> fin;
  fin.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  fin.elements = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const auto fin_sides = build_sides(fin);
  check_rows_against_edges(side_dual<2>(fin_sides));
  CHECK(num_edges(element_dual<2>(fin_sides)) == 0); // a side with three elements has no EDG edge
  check_rows_against_edges(element_dual<2>(fin_sides));
  CHECK(out_degree(local_id{0}, element_dual<2>(fin_sides)) == 0);
}

TEST_CASE("a view with cut and non-manifold sides leaves out both, in rows and in the list") {
  simplicial_mesh<2> mesh = dovetail_test::jittered_squares(3);
  // A fin on the first inner side, and a triangle beyond it, which only the fin reaches.
  const auto plane_sides = build_sides(mesh);
  local_id inner = 0;
  while (!plane_sides.is_interior(inner))
    ++inner;
  const auto edge = plane_sides.vertices[static_cast<std::size_t>(inner)];
  const auto tip = static_cast<local_id>(mesh.points.size());
  mesh.points.push_back({0.5, 0.5, 1});
  mesh.points.push_back({0.5, 0.5, 2});
  mesh.elements.push_back({edge[0], edge[1], tip});
  mesh.elements.push_back({edge[0], tip, tip + 1});
  const auto sides = build_sides(mesh);
  REQUIRE(sides.further_elements.size() == 1);

  std::vector<std::uint8_t> cut(sides.size(), 0);
  std::size_t interior = 0, kept = 0;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    cut[s] = s % 3 == 0 ? 1 : 0;
    if (!sides.is_interior(static_cast<local_id>(s)))
      continue;
    ++interior;
    kept += cut[s] == 0 ? 1 : 0;
  }
  REQUIRE(kept < interior);
  check_rows_against_edges(element_dual<2>(sides));
  check_rows_against_edges(element_dual<2>(sides, cut));
  CHECK(num_edges(element_dual<2>(sides)) == interior);
  CHECK(num_edges(element_dual<2>(sides, cut)) == kept);
}

TEST_CASE("Boost's connected components see the cut sides") {
  auto mesh = dovetail_test::jittered_cubes(4);
  const auto sides = build_sides(mesh);
  std::vector<local_id> component(mesh.elements.size());
  CHECK(boost::connected_components(element_dual<3>(sides), component.data()) == 1);

  // Cut between the cells below and above the middle plane.
  const std::size_t half = mesh.elements.size() / 2;
  std::vector<std::uint8_t> cut(sides.size(), 0);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_interior(static_cast<local_id>(s)))
      cut[s] = (static_cast<std::size_t>(sides.elements[s][0]) < half) !=
               (static_cast<std::size_t>(sides.elements[s][1]) < half);
  CHECK(boost::connected_components(element_dual<3>(sides, cut), component.data()) == 2);
  CHECK(component.front() != component.back());

  const auto side_graph = side_dual<3>(sides);
  std::vector<int> side_component(sides.size());
  CHECK(boost::connected_components(side_graph, side_component.data()) == 1);
}

TEST_CASE("Boost's breadth-first search counts rings of elements") {
  const auto mesh = dovetail_test::jittered_squares(6);
  const auto sides = build_sides(mesh);
  const element_dual<2> dual(sides);
  std::vector<int> ring(mesh.elements.size(), 0);
  boost::breadth_first_search(
      dual, local_id{0},
      boost::visitor(boost::make_bfs_visitor(boost::record_distances(ring.data(), boost::on_tree_edge()))));
  // By hand: relax until nothing changes.
  std::vector<int> expected(mesh.elements.size(), 1 << 20);
  expected[0] = 0;
  const auto neighbours = element_neighbours(sides);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t e = 0; e < neighbours.size(); ++e)
      for (const local_id other : neighbours[e])
        if (other != no_id && expected[static_cast<std::size_t>(other)] + 1 < expected[e]) {
          expected[e] = expected[static_cast<std::size_t>(other)] + 1;
          changed = true;
        }
  }
  CHECK(ring == expected);

  const auto order = breadth_first_order(dual, local_id{0});
  REQUIRE(order.size() == mesh.elements.size());
  for (std::size_t k = 1; k < order.size(); ++k)
    CHECK(ring[static_cast<std::size_t>(order[k - 1])] <= ring[static_cast<std::size_t>(order[k])]);
}

TEST_CASE("Boost's Dijkstra gives the same distances on the view and on the csr graph") {
  const auto mesh = dovetail_test::jittered_cubes(3);
  const auto sides = build_sides(mesh);
  const element_dual<3> dual(sides);
  const csr_graph csr = element_graph(sides);
  const auto weight = [](const graph_edge& e) { return 1.0 + static_cast<double>(e.index % 7); };
  std::vector<double> on_view(mesh.elements.size());
  std::vector<double> on_csr(mesh.elements.size());
  boost::dijkstra_shortest_paths(
      dual, local_id{0},
      boost::distance_map(on_view.data())
          .weight_map(boost::make_function_property_map<graph_edge, double>(weight)));
  boost::dijkstra_shortest_paths(csr, local_id{0}, boost::distance_map(on_csr.data()));
  CHECK(on_view == on_csr);
}

TEST_CASE("Boost's minimum spanning tree runs on the csr graph") {
  const csr_graph csr = element_graph(build_sides(dovetail_test::jittered_cubes(2)));
  std::vector<graph_edge> tree;
  boost::kruskal_minimum_spanning_tree(csr, std::back_inserter(tree));
  CHECK(tree.size() + 1 == num_vertices(csr));
}
