#include "dovetail/core/error.hpp"
#include "dovetail/files/concepts.hpp"
#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "files/file_size_limit.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <set>
#include <string>

using namespace dovetail;
using testing::cubes_in_eight;

static_assert(mesh_writer<io::vtu_writer>);
static_assert(mesh_writer<io::msh_writer>);
static_assert(mesh_writer<io::vtu_writer, 2> && mesh_writer<io::msh_writer, 2>);
static_assert(mesh_writer<io::partitioned_msh_writer, 3> && !mesh_writer<io::partitioned_msh_writer, 2>);

namespace {

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

} // namespace

TEST_CASE("a mesh becomes one PVTU, a VTU per subdomain and two VTP files") {
  const testing::scratch_folder folder("vtu_files");
  const auto summary = io::vtu_writer{}(cubes_in_eight.distributed(), folder);
  CHECK(names_in(folder) == std::set<std::string>{"mesh.pvtu", "mesh_0000.vtu", "mesh_0001.vtu",
                                                  "mesh_0002.vtu", "mesh_0003.vtu", "mesh_0004.vtu",
                                                  "mesh_0005.vtu", "mesh_0006.vtu", "mesh_0007.vtu",
                                                  "surface.vtp", "interfaces.vtp"});
  CHECK(summary.get("elements") == 6 * 8 * 8 * 8);
  CHECK(summary.get("files") == 11);
  std::uintmax_t bytes = 0;
  for (const auto& name : names_in(folder))
    bytes += std::filesystem::file_size(folder / name);
  CHECK(summary.get("bytes") == static_cast<double>(bytes));
}

TEST_CASE("files of an earlier mesh in the folder disappear, other files stay") {
  const testing::scratch_folder folder("vtu_stale");
  io::vtu_writer{}(cubes_in_eight.distributed(), folder);
  testing::write_content(folder / "mesh_mine.vtu", "x");
  testing::write_content(folder / "notes.txt", "x");
  io::vtu_writer{.files = 3}(cubes_in_eight.distributed(), folder);
  CHECK(names_in(folder) == std::set<std::string>{"mesh.pvtu", "mesh_0000.vtu", "mesh_0001.vtu",
                                                  "mesh_0002.vtu", "mesh_mine.vtu", "notes.txt",
                                                  "surface.vtp", "interfaces.vtp"});
}

TEST_CASE("pieces are loaded once, in order") {
  const testing::scratch_folder folder("vtu_streaming");
  auto mesh = cubes_in_eight.distributed();
  std::vector<local_id> loads;
  mesh.load = [&, load = mesh.load](local_id p) {
    loads.push_back(p);
    return load(p);
  };
  io::vtu_writer{}(mesh, folder);
  CHECK(loads == std::vector<local_id>{0, 1, 2, 3, 4, 5, 6, 7});
  loads.clear();
  io::msh_writer{}(mesh, folder);
  CHECK(loads == std::vector<local_id>{0, 1, 2, 3, 4, 5, 6, 7});
}

TEST_CASE("a file that would not fit leaves no trace, and the error names it") {
  const testing::scratch_folder folder("vtu_full");
  const auto mesh = cubes_in_eight.distributed();
  const auto refused = [&](std::size_t bytes, const auto& writer, const char* file) {
    const testing::file_size_limit limit(bytes);
    CHECK_THROWS_WITH_AS(writer(mesh, folder), doctest::Contains(file), io_error);
    CHECK(names_in(folder).empty());
  };
  refused(10000, io::vtu_writer{}, "mesh_0000.vtu");
  refused(10000, io::msh_writer{}, "mesh_0.msh_piece");
  refused(50000, io::msh_writer{}, "mesh.msh");
}

TEST_CASE("a failure leaves an older mesh as it was") {
  const testing::scratch_folder folder("vtu_old");
  io::vtu_writer{.files = 2}(cubes_in_eight.distributed(), folder);
  const auto names = names_in(folder);
  const auto piece = testing::file_content(folder / "mesh_0001.vtu");
  auto broken = cubes_in_eight.distributed();
  broken.load = [load = broken.load](local_id p) {
    if (p == 5)
      throw io_error("spool file lost");
    return load(p);
  };
  CHECK_THROWS_AS(io::vtu_writer{}(broken, folder), io_error);
  CHECK(names_in(folder) == names);
  CHECK(testing::file_content(folder / "mesh_0001.vtu") == piece);
}

TEST_CASE("a folder that cannot be made or written is an io_error that names it") {
  const testing::scratch_folder folder("vtu_unwritable");
  testing::write_content(folder / "file", "x");
  const auto mesh = cubes_in_eight.distributed();
  CHECK_THROWS_WITH_AS(io::vtu_writer{}(mesh, folder / "file"), doctest::Contains("file"), io_error);
  CHECK_THROWS_WITH_AS(io::vtu_writer{}(mesh, folder / "file/below"), doctest::Contains("file/below"),
                       io_error);
  CHECK_THROWS_WITH_AS(io::msh_writer{}(mesh, folder / "file/below"), doctest::Contains("file/below"),
                       io_error);
  CHECK_THROWS_WITH_AS(io::msh_writer{}(mesh, "/proc"), doctest::Contains("/proc/unfinished"), io_error);
  CHECK(testing::file_content(folder / "file") == "x");
}

TEST_CASE("a full device is an io_error when the buffer is flushed, at the latest at the commit") {
  if (!std::filesystem::exists("/dev/full"))
    return;
  const testing::scratch_folder folder("vtu_device");
  std::filesystem::create_symlink("/dev/full", folder / "a.part");
  output_file file(folder / "a");
  file.text("hello");
  CHECK_THROWS_WITH_AS(file.commit(), doctest::Contains("No space left"), io_error);
  CHECK_FALSE(std::filesystem::exists(folder / "a"));
}

TEST_CASE("output to nested folders that do not exist yet") {
  const testing::scratch_folder folder("vtu_nested");
  io::vtu_writer{.stem = "part"}(cubes_in_eight.distributed(), folder / "a/b/c");
  CHECK(std::filesystem::exists(folder / "a/b/c/part.pvtu"));
}

TEST_CASE("two writings of the same mesh are the same bytes") {
  const testing::scratch_folder folder("vtu_same");
  io::vtu_writer{}(cubes_in_eight.distributed(), folder / "a");
  io::vtu_writer{}(cubes_in_eight.distributed(), folder / "b");
  for (const auto& name : names_in(folder / "a"))
    CHECK(testing::file_content(folder / "a" / name) == testing::file_content(folder / "b" / name));
}

TEST_CASE("skeleton points that no triangle of the subdomain has are refused") {
  const testing::scratch_folder folder("vtu_disagree");
  auto mesh = cubes_in_eight.distributed();
  mesh.load = [load = mesh.load](local_id p) {
    auto piece = load(p);
    if (p == 2)
      piece.skeleton_points[0] = load(5).skeleton_points.back();
    return piece;
  };
  CHECK_THROWS_WITH_AS(io::vtu_writer{}(mesh, folder), doctest::Contains("subdomain 2"), mesh_error);
  CHECK(names_in(folder).empty());
}
