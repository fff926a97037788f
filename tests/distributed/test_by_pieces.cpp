// Whole pieces to ranks: even, connected, repeatable, with a report that says so.
#include "files/stacked_cubes.hpp"
#include "lumps.hpp"

#include "dovetail/distributed/any_redistributor.hpp"
#include "dovetail/distributed/by_pieces.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <string>
#include <vector>

using namespace dovetail;
using dovetail::testing::lumps;

namespace {

double imbalance(const distributed_mesh& mesh, const redistribution<3>& given, int ranks) {
  std::vector<double> elements(static_cast<std::size_t>(ranks), 0);
  double all = 0;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
    elements[given.rank_of_piece[p]] += static_cast<double>(mesh.counts[p].elements);
    all += static_cast<double>(mesh.counts[p].elements);
  }
  return *std::max_element(elements.begin(), elements.end()) * ranks / all;
}

} // namespace

TEST_CASE("with 20 pieces per rank, ranks are connected and within 5 % of the average") {
  for (const int ranks : {2, 3, 7})
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      CAPTURE(ranks);
      CAPTURE(seed);
      const auto mesh = lumps(20 * ranks, seed);
      const auto given = redistribution_by::pieces{}(mesh, ranks);
      CHECK(given.summary.get("imbalance") <= 1.05);
      CHECK(given.summary.get("imbalance") == doctest::Approx(imbalance(mesh, given, ranks)));
      CHECK(given.summary.get("disconnected_ranks") == 0);
      CHECK(given.summary.get("most_neighbours") >= 1);
      CHECK(given.summary.get("sides_between_ranks") > 0);
      CHECK(given.rank_of_piece == redistribution_by::pieces{}(mesh, ranks).rank_of_piece);
    }
}

TEST_CASE("any partitioner does, also one that goes by place, and its strays are joined") {
  const auto mesh = lumps(60, 3);
  const auto by_place = redistribution_by::pieces{.partitioner = partition::recursive_coordinate{}}(mesh, 3);
  CHECK(by_place.summary.get("imbalance") <= 1.05);
  CHECK(by_place.summary.get("disconnected_ranks") == 0);
  const auto in_turn = [](const csr_graph& graph, int parts) {
    std::vector<local_id> part;
    for (local_id v = 0; v < graph.node_count(); ++v)
      part.push_back(v % parts);
    return part;
  };
  const auto mended = redistribution_by::pieces{.partitioner = any_partitioner(in_turn)}(mesh, 3);
  CHECK(mended.summary.get("disconnected_ranks") == 0);
  CHECK(mended.summary.get("imbalance") < 1.2);
}

TEST_CASE("the graph of pieces counts elements and sides") {
  const testing::stacked_cubes cubes{.cells = 4, .cuts = 2};
  const auto graph = piece_graph(cubes.distributed());
  REQUIRE(graph.node_count() == 8);
  for (local_id p = 0; p < 8; ++p) {
    CHECK(graph.node_weight(p) == 6 * 8);
    CHECK(graph.row(p).size() == 3);
    graph.for_each_edge(p, [](local_id, double sides) { CHECK(sides == 8); });
    CHECK((graph.positions[p].x < 0.5) == (p % 2 == 0));
  }
}

TEST_CASE("blocks go by numbers; disconnected ranks are reported") {
  const auto mesh = testing::stacked_cubes{.cells = 4, .cuts = 2}.distributed();
  const auto given = redistribution_by::blocks{}(mesh, 3);
  CHECK(given.rank_of_piece == std::vector<local_id>{0, 0, 0, 1, 1, 1, 2, 2});
  CHECK(given.summary.get("imbalance") == doctest::Approx(9.0 / 8));
  CHECK(given.summary.get("largest_rank") == 3 * 48);
  CHECK(given.summary.get("smallest_rank") == 2 * 48);
  CHECK(given.summary.get("disconnected_ranks") == 1); // pieces 3 and 4 touch in the centre alone
}

TEST_CASE("more ranks than pieces are refused, and so are ranks that no solver can use") {
  const auto mesh = testing::stacked_cubes{.cells = 2, .cuts = 2}.distributed();
  CHECK_THROWS_AS(redistribution_by::pieces{}(mesh, 9), partition_error);
  CHECK_THROWS_AS(redistribution_by::blocks{}(mesh, 0), partition_error);
  const auto gives = [](std::vector<local_id> ranks) {
    return any_redistributor<3>(
        [ranks](const distributed_mesh&, int) {
          return redistribution<3>{ranks, {}, {}};
        },
        "mine");
  };
  CHECK_THROWS_WITH_AS(gives({0, 1})(mesh, 2),
                       "the redistributor 'mine' gave 2 pieces to ranks, the mesh has 8", partition_error);
  CHECK_THROWS_WITH_AS(gives({0, 1, 0, 1, 0, 1, 0, 2})(mesh, 2),
                       "the redistributor 'mine' gave a piece to rank 2 of 2", partition_error);
  CHECK_THROWS_WITH_AS(gives({0, 0, 0, 0, 0, 0, 0, 0})(mesh, 2),
                       "the redistributor 'mine' left rank 1 of 2 without a piece", partition_error);
  CHECK(any_redistributor<3>(redistribution_by::pieces{}, "by-pieces")(mesh, 8).rank_of_piece.size() == 8);
}
