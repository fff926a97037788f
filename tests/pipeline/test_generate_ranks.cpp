#include "dovetail/distributed/ranks.hpp"
#include "dovetail/mesher/native_surface.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/spool_exchange.hpp"
#include "dovetail/pipeline/model_measure.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "models/discrete_shapes.hpp"
#include "ranked_meshes.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <optional>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

plane_domain square_with_hole() {
  plane_drawing drawing;
  drawing.polygons = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "square"},
                      {{{0.3, 0.3}, {0.5, 0.3}, {0.5, 0.6}, {0.3, 0.6}}, "hole"}};
  return plane_domain(drawing);
}

ranked_mesh mesh_square(const any_executor& run, const std::filesystem::path& folder,
                        const generate_options& options = {}) {
  return mesh_on<2>(run, square_with_hole(), 0.03, mesher::native_surface{}, options, folder);
}

/// Counts how often it is asked for its volume.
struct asked_cube : discrete_model {
  explicit asked_cube(std::atomic<int>& times)
      : discrete_model(repaired(box_soup({0, 0, 0}, {1, 1, 1}, 2))), asked(&times) {}
  std::optional<double> volume() const {
    ++*asked;
    return discrete_model::volume();
  }
  std::atomic<int>* asked;
};

} // namespace

TEST_CASE("one of the ranks asks a model for its volume, and all compare it") {
  std::atomic<int> asked = 0;
  const asked_cube cube(asked);
  parallel::run_ranks(3, [&](parallel::in_process& mine) {
    const auto made =
        generate<3>(cube, uniform_size(0.5), parameters<>{}.with_executor(parallel::ranks(mine)));
    CHECK(made.summary.as<volume_counts>().model_volume == doctest::Approx(1));
  });
  CHECK(asked == 1);
}

TEST_CASE("ranks make the mesh and the files that one process makes, whatever their number") {
  const scratch_folder folder("ranks");
  const ranked_mesh alone = mesh_square(parallel::serial{}, folder / "alone");
  REQUIRE(alone.files.size() > 4);
  for (const int count : {1, 2, 3, 4, 7}) {
    CAPTURE(count);
    const auto into = folder / std::to_string(count);
    parallel::run_ranks(
        count, [&](parallel::in_process& mine) { CHECK(mesh_square(parallel::ranks(mine), into) == alone); });
  }
}

TEST_CASE("a graph that is partitioned in groups makes the same mesh on any number of ranks") {
  const scratch_folder folder("ranks");
  generate_options options;
  options.subdomains = 24;
  const ranked_mesh at_once = mesh_square(parallel::serial{}, folder / "at_once", options);
  options.partitioned_at_once = 24;
  const ranked_mesh alone = mesh_square(parallel::serial{}, folder / "alone", options);
  CHECK_FALSE(alone == at_once);
  for (const int count : {1, 2, 4})
    parallel::run_ranks(count, [&](parallel::in_process& mine) {
      CHECK(mesh_square(parallel::ranks(mine), folder / std::to_string(count), options) == alone);
    });
}

TEST_CASE("ranks with spools that the others do not see make the same mesh, and go on with other ranks") {
  const scratch_folder folder("ranks");
  const run_identity identity{{"test", "1"}};
  const ranked_mesh alone = mesh_square(parallel::serial{}, folder / "alone");
  const auto mesh = [&](int count, bool again) {
    CAPTURE(count);
    const auto into = folder / ("of_" + std::to_string(count));
    parallel::run_ranks(count, [&](parallel::in_process& mine) {
      const auto disk = folder / ("disk_" + std::to_string(mine.rank()));
      const spool own =
          (again && spool::is_started(disk) ? spool::resume(disk, identity) : spool::start(disk, identity))
              .of_one_rank();
      any_communicator network(mine);
      if (again)
        exchange_all_blobs(own, network);
      const auto before = file_count(disk);
      CHECK(mesh_square(parallel::checkpointed(parallel::ranks(network), own), into) == alone);
      if (again)
        CHECK(file_count(disk) == before); // nothing was made
    });
  };
  mesh(3, false);
  const auto lines = file_count(folder / "disk_1");
  CHECK(lines > 4);
  CHECK(file_count(folder / "disk_0") >= lines); // rank 0 has what is made once
  mesh(2, true);
  std::filesystem::remove_all(folder / "disk_0"); // a disk that is lost
  mesh(4, true);
}

TEST_CASE("an error of one rank ends the run on all") {
  const scratch_folder folder("ranks");
  const auto mesh = [&](parallel::in_process& mine) {
    generate_options options;
    if (mine.rank() == 1)
      options.on_progress.update = [](std::string_view stage, std::size_t, std::size_t) {
        if (stage == "meshing")
          throw io_error("disk of rank 1");
      };
    mesh_square(parallel::ranks(mine), folder, options);
  };
  CHECK_THROWS_WITH_AS(parallel::run_ranks(3, mesh), "disk of rank 1", io_error);
}
