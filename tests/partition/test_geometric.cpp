#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/partition/inertial.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "dovetail/partition/space_filling_curve.hpp"
#include "partition/partitioner_contract.hpp"

#include <array>
#include <cstdlib>
#include <numeric>

using namespace dovetail;

namespace {

template <graph_partitioner P>
void check_needs_positions(const P& partitioner) {
  csr_graph graph = dovetail_test::element_graph(dovetail_test::jittered_squares(4));
  graph.positions[3].y = std::nan("");
  CHECK_THROWS_WITH_AS(partitioner(graph, 2), doctest::Contains("node 3"), partition_error);
  graph.positions.clear();
  CHECK_THROWS_WITH_AS(partitioner(graph, 2), doctest::Contains("positions"), partition_error);
}

} // namespace

TEST_CASE("partitioners that go by place say so where a node has none") {
  check_needs_positions(partition::recursive_coordinate{});
  check_needs_positions(partition::inertial{});
  check_needs_positions(partition::space_filling_curve{});
}

TEST_CASE("decompose tells partitioners where its super-elements are") {
  const auto mesh = dovetail_test::jittered_cubes(6);
  const auto sides = build_sides(mesh);
  std::vector<local_id> super(mesh.elements.size());
  std::iota(super.begin(), super.end(), 0);
  csr_graph graph = dovetail_test::element_graph(mesh);
  graph.positions.clear(); // as the simplification makes it
  const auto pieces = decompose<3>(mesh, sides, super, graph, {}, partition::recursive_coordinate{}, 4);
  CHECK(pieces.parts == 4);
  CHECK(imbalance_of(graph, pieces.part_of_super, 4) <= 1.05);
}

TEST_CASE("contraction averages positions, and a piece keeps its own") {
  csr_graph path = make_csr_graph({1, 1, 1}, std::vector<weighted_edge>{{0, 1, 1}, {1, 2, 1}});
  path.positions = {{0, 0, 0}, {1, 0, 0}, {5, 0, 0}};
  const std::vector<local_id> label{0, 0, 1};
  CHECK(contract(path, label, 2).positions == std::vector<vec3>{{0.5, 0, 0}, {5, 0, 0}});
  CHECK(induced_subgraph(path, label, 1).graph.positions == std::vector<vec3>{{5, 0, 0}});
}

TEST_CASE("the inertial axis follows a slanted bar, the coordinate axes do not") {
  csr_graph bar = dovetail_test::element_graph(dovetail_test::jittered_cubes(6));
  for (vec3& p : bar.positions) { // long along the first axis, then turned by 45 degrees
    const vec3 stretched{12 * p.x, p.y, p.z};
    p = {stretched.x - stretched.y, stretched.x + stretched.y, p.z};
  }
  const partition::inertial inertial{.refinement_passes = 0};
  const partition::recursive_coordinate boxes{.refinement_passes = 0};
  CHECK(edge_cut(bar, inertial(bar, 2)) < edge_cut(bar, boxes(bar, 2)));
}
