// Improvement after redistribution: the pieces of ranks, each inside its interfaces.
#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/improve_pieces.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/improver/any_improver.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "files/scratch_folder.hpp"
#include "lumps.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

const redistribution_by::elements by_elements{.super_elements = 40};

improved_pieces improve(const distributed_mesh& mesh, const any_executor& run = parallel::serial{}) {
  return improve_pieces(mesh, improvement::native{}, {}, run);
}

} // namespace

TEST_CASE("what was at an interface when it was meshed is improved after redistribution") {
  const auto mesh = lumps(24, 5, 0.6);
  REQUIRE(io::check_distributed(mesh).valid());
  const auto in_pieces = improve(mesh);
  CHECK(in_pieces.summary.get("elements") == 6 * 12 * 12 * 12);
  CHECK(in_pieces.summary.get("improver_seconds") > 0);
  CHECK(io::check_distributed(in_pieces.mesh).text() == "");
  const auto low = [](const improved_pieces& made) { return made.quality.min_dihedrals.below(24); };
  const auto after = improve(*by_elements(in_pieces.mesh, 3).mesh);
  CHECK(io::check_distributed(after.mesh).text() == "");
  CHECK(after.summary.get("pieces") == 3);
  CHECK(low(in_pieces) > 0);
  CHECK(low(after) < low(in_pieces));
  const auto only_after = improve(*by_elements(mesh, 3).mesh);
  CHECK(low(only_after) < low(in_pieces));
  std::int64_t measured = 0;
  for (std::size_t p = 0; p < in_pieces.mesh.counts.size(); ++p) {
    const auto piece = io::load_checked(in_pieces.mesh, static_cast<local_id>(p));
    measured += measure_quality(piece.mesh).min_dihedrals.below(24);
  }
  CHECK(measured == low(in_pieces));
}

TEST_CASE("pieces are improved alike by every executor, any number of ranks, and with a spool") {
  const auto mesh = lumps(8, 5, 0.5);
  const auto hash = io::mesh_hash(improve(mesh).mesh);
  CHECK(hash != io::mesh_hash(mesh));
  const scratch_folder folder("improve_pieces");
  const auto disk = spool::start(folder / "spool", {{"test", "1"}});
  CHECK(io::mesh_hash(improve(mesh, parallel::processes{.worker_count = 2}).mesh) == hash);
  CHECK(io::mesh_hash(
            improve(mesh, parallel::checkpointed(parallel::processes{.worker_count = 2}, disk)).mesh) ==
        hash);
  parallel::run_ranks(3, [&](parallel::in_process& mine) {
    CHECK(io::mesh_hash(improve(mesh, parallel::ranks(mine)).mesh) == hash);
  });
}

namespace {

/// Does what it likes with a mesh.
struct spoiler {
  static constexpr improver_traits traits{};
  void (*spoil)(simplicial_mesh<3>&) = nullptr;

  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>&, const any_sizing&) const {
    spoil(mesh);
    return {};
  }
};

} // namespace

TEST_CASE("an improver that spoils a piece is named, and one that is not thread-safe kept out of threads") {
  const auto mesh = lumps(3, 1);
  for (const auto spoil :
       {+[](simplicial_mesh<3>& piece) { piece.elements.pop_back(); },
        +[](simplicial_mesh<3>& piece) { piece.points.front().x += 1e-9; },
        +[](simplicial_mesh<3>& piece) { std::swap(piece.elements[0][0], piece.elements[0][1]); }})
    CHECK_THROWS_WITH_AS(
        improve_pieces(mesh, any_improver<3>(spoiler{spoil}, "mine"), {}, parallel::serial{}),
        doctest::Contains("the improver 'mine' left no mesh: subdomain 0"), mesh_error);
  CHECK_THROWS_AS(
      improve_pieces(mesh, any_improver<3>(spoiler{}, "mine"), {}, parallel::threads{.worker_count = 2}),
      usage_error);
  auto quadratic = mesh;
  quadratic.mid_nodes = std::make_shared<mid_edge_nodes<3>>();
  CHECK_THROWS_AS(improve(quadratic), usage_error);
}
