#include "dovetail/io/concepts.hpp"
#include "dovetail/io/msh_writer.hpp"
#include "io/stacked_cubes.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

static_assert(mesh_writer<io::msh_writer>);

TEST_CASE("a") {
  const auto folder = std::filesystem::temp_directory_path() / "dovetail_test_msh_writer";
  std::filesystem::remove_all(folder);
  const auto mesh = testing::stacked_cubes{.cells = 8, .cuts = 2, .solids = 2}.distributed();
  for (const bool partitioned : {false, true})
    for (const bool binary : {false, true}) {
      const auto summary = io::msh_writer{.partitioned = partitioned,
                                          .ghosts = true,
                                          .binary = binary,
                                          .stem = std::string("m") + (partitioned ? "p" : "w") +
                                                  (binary ? "b" : "a")}(mesh, folder);
      CHECK(summary.get("elements") == 6 * 8 * 8 * 8);
    }
}
