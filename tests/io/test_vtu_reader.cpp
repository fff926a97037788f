#include "dovetail/io/concepts.hpp"
#include "dovetail/io/mesh_hash.hpp"
#include "dovetail/io/vtu_reader.hpp"
#include "dovetail/io/vtu_writer.hpp"
#include "dovetail/io/write_mesh.hpp"
#include "io/scratch_folder.hpp"
#include "io/stacked_cubes.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

static_assert(mesh_reader<io::vtu_reader>);

namespace {
const testing::stacked_cubes cubes{.cells = 6, .cuts = 2, .solids = 2, .jitter = 0.3};
}

TEST_CASE("a distributed mesh reads back with the same hash, for any number of pieces") {
  const auto mesh = cubes.distributed();
  for (const int pieces : {0, 1, 3}) {
    const testing::scratch_folder folder("vtu_reread");
    io::vtu_writer{.pieces = pieces}(mesh, folder);
    const auto read = io::vtu_reader{}(folder / "mesh.pvtu");
    CHECK(read.mesh.elements.size() == 6 * 6 * 6 * 6);
    CHECK(read.mesh.points.size() == 7 * 7 * 7);
    CHECK(read.subdomains.size() == read.mesh.elements.size());
    CHECK(std::count(read.mesh.tags.begin(), read.mesh.tags.end(), 1) == 3 * 6 * 6 * 6);
    REQUIRE(read.region_names.size() == 2);
    CHECK(read.region_names[1].second == "solid \"1\" <&>");
    CHECK(io::mesh_hash(read) == io::mesh_hash(mesh));
  }
}
