#include "dovetail/io/concepts.hpp"
#include "dovetail/io/vtu_writer.hpp"
#include "io/stacked_cubes.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

static_assert(mesh_writer<io::vtu_writer>);

TEST_CASE("a distributed mesh becomes one PVTU and a VTU per subdomain") {
  const auto folder = std::filesystem::temp_directory_path() / "dovetail_test_vtu_writer";
  std::filesystem::remove_all(folder);
  const auto mesh = testing::stacked_cubes{.cells = 8, .cuts = 2, .solids = 2}.distributed();
  const auto summary = io::vtu_writer{}(mesh, folder);
  CHECK(summary.get("elements") == 6 * 8 * 8 * 8);
  CHECK(summary.get("files") == 8 + 3);
}
