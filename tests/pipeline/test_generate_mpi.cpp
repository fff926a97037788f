/// @file
/// Runs on all ranks of an mpirun, in a program that initialises MPI itself.
#include "support/mpi_main.hpp"

#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/mpi.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/serial.hpp"
#include "models/discrete_shapes.hpp"
#include "ranked_meshes.hpp"

#include <optional>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

ranked_mesh mesh_ball(const any_executor& run, const std::filesystem::path& folder) {
  const discrete_model ball(repaired(sphere_soup({0, 0, 0}, 1, 8)));
  return mesh_on<3>(run, ball, 0.2, mesher::tetgen{}, {}, folder);
}

/// As those do whose library may crash or has one state for all.
struct forking_mesher : mesher::tetgen {
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    parallel::processes{1}.run(1, [](std::size_t) { return byte_buffer{}; });
    return mesher::tetgen::operator()(input, size);
  }
};

} // namespace

TEST_CASE("a program with MPI makes the mesh and the files that one process makes") {
  std::optional<scratch_folder> own;
  const any_executor run = parallel::ranks(*world);
  const auto folder = once(run, [&] { return std::filesystem::path(own.emplace("mpi")); });
  const ranked_mesh alone =
      mesh_ball(parallel::serial{}, folder / ("alone_" + std::to_string(world->rank())));
  CHECK(alone.files.size() > 4);
  CHECK(mesh_ball(run, folder / "ranks") == alone);
  world->agree(); // or the folder would go too early
}

TEST_CASE("a mesher that forks is refused in a program with MPI, whatever its fallbacks are") {
  const any_mesher<3> forks =
      any_mesher<3>(forking_mesher{}, "forks").with_fallback({mesher::tetgen{}, "tetgen"});
  const discrete_model ball(repaired(sphere_soup({0, 0, 0}, 1, 8)));
  const scratch_folder own("mpi");
  CHECK_THROWS_WITH_AS(mesh_on<3>(parallel::ranks(*world), ball, 0.2, forks, {}, own / "out"),
                       doctest::Contains("that has initialised MPI"), usage_error);
}
