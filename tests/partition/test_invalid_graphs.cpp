/// A graph that is none is named, and not the partitioner it was given to.
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/inertial.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "dovetail/partition/space_filling_curve.hpp"
#include "partition/partitioner_contract.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace dovetail;
using testing::has;

namespace {

struct broken_graph {
  const char* message; ///< part of what is said
  std::function<void(csr_graph&)> change;
};

/// Where the row of node 1 begins, which has more than one neighbour.
std::size_t row_of_one(const csr_graph& graph) {
  return static_cast<std::size_t>(graph.offsets[1]);
}

std::vector<broken_graph> broken_graphs() {
  const auto neighbour = [](local_id w) { return [w](csr_graph& g) { g.neighbours[row_of_one(g)] = w; }; };
  const auto edge_weight = [](double w) { return [w](csr_graph& g) { g.edge_weights[row_of_one(g)] = w; }; };
  const auto node_weight = [](double w) { return [w](csr_graph& g) { g.node_weights[1] = w; }; };
  return {{"node 1 is a neighbour of itself", neighbour(1)},
          {"node 1 has the neighbour 9999", neighbour(9999)},
          {"node 1 has the neighbour -1", neighbour(-1)},
          {"for a neighbour, but not the other way round", neighbour(40)},
          {"another weight in the row of one", edge_weight(5)},
          {"has weight -1", edge_weight(-1)},
          {"has weight nan", edge_weight(std::nan(""))},
          {"node 1 has weight -1", node_weight(-1)},
          {"node 1 has weight inf", node_weight(std::numeric_limits<double>::infinity())},
          {"edge weights for", [](csr_graph& g) { g.edge_weights.pop_back(); }},
          {"offsets for", [](csr_graph& g) { g.node_weights.pop_back(); }},
          {"positions for", [](csr_graph& g) { g.positions.pop_back(); }},
          {"its rows are from 0 to", [](csr_graph& g) { g.offsets.back() += 1; }},
          {"its rows are from 1", [](csr_graph& g) { g.offsets.front() = 1; }},
          {"offsets must not fall", [](csr_graph& g) { g.offsets[2] = 0; }}};
}

/// Says what it is given.
struct careless_partitioner {
  std::vector<local_id> operator()(const csr_graph& graph, int) const {
    return std::vector<local_id>(graph.node_weights.size() + 1, 0);
  }
};

} // namespace

TEST_CASE("a graph that is none is refused by name, whoever is to partition it") {
  const auto valid = dovetail_test::element_graph(dovetail_test::jittered_cubes(2));
  const std::vector<any_partitioner> partitioners{
      {careless_partitioner{}, "mine"}, {partition::greedy{}, "greedy"}, {partition::inertial{}, "inertial"}};
  for (const auto& broken : broken_graphs()) {
    CAPTURE(broken.message);
    csr_graph graph = valid;
    broken.change(graph);
    const auto told = [&](const auto& partitioner) {
      return testing::refusal_of<partition_error>([&] { return partitioner(graph, 2); });
    };
    for (const auto& partitioner : partitioners) {
      const std::string message = told(partitioner);
      CHECK(has(message, broken.message));
      CHECK(message.rfind("the graph: ", 0) == 0);
    }
    CHECK(has(told(partition::greedy{}), broken.message));
    CHECK(has(told(partition::inertial{}), broken.message));
    CHECK(has(told(partition::recursive_coordinate{}), broken.message));
    CHECK(has(told(partition::space_filling_curve{}), broken.message));
  }
}

TEST_CASE("weights that are wrong in two edges do not make up for each other") {
  csr_graph path;
  path.node_weights = {1, 1, 1};
  path.offsets = {0, 1, 3, 4};
  path.neighbours = {1, 0, 2, 1};
  path.edge_weights = {1, 2, 2, 1};
  CHECK_THROWS_WITH_AS(require_valid_graph(path), doctest::Contains("has another weight"), partition_error);
  path.edge_weights = {1, 1, 2, 2};
  require_valid_graph(path);
}

TEST_CASE("valid graphs pass: edges added up in another order, no edges, one node") {
  auto graph = dovetail_test::element_graph(dovetail_test::jittered_cubes(3), 7);
  require_valid_graph(graph);
  for (local_id v = 0; v < graph.node_count(); ++v) { // rows in any order
    const auto first = static_cast<std::size_t>(graph.offsets[v]);
    if (graph.row(v).size() > 1) {
      std::swap(graph.neighbours[first], graph.neighbours[first + 1]);
      std::swap(graph.edge_weights[first], graph.edge_weights[first + 1]);
    }
  }
  graph.edge_weights[0] *= 1 + 1e-15;
  require_valid_graph(graph);
  require_valid_graph({});
  csr_graph apart;
  apart.offsets = {0, 0, 0};
  apart.node_weights = {1, 0};
  require_valid_graph(apart);
}
