#include "file_place.hpp"

#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace dovetail::app {
namespace {

TEST_CASE("however a file is spelled, it has one place") {
  const testing::scratch_folder folder("places");
  const std::filesystem::path base = folder / ".";
  std::filesystem::create_directories(folder / "a/b");
  std::ofstream(folder / "a/file") << "text";
  std::filesystem::create_symlink("a", folder / "link");
  std::filesystem::create_symlink("a/file", folder / "to_file");
  std::filesystem::create_hard_link(folder / "a/file", folder / "hard");
  for (const char* name : {"a/./file", "a/b/../file", "link/file", "to_file", "hard", "link/b/../file"}) {
    CAPTURE(name);
    CHECK(place_of(base / name) == place_of(folder / "a/file"));
  }
  for (const char* name : {"a/none", "a/b", "file", "a/file2"}) {
    CAPTURE(name);
    CHECK_FALSE(place_of(base / name) == place_of(folder / "a/file"));
  }
  CHECK(place_of(folder / "a/x/y") == place_of(folder / "link/b/../x/./y"));
  CHECK(place_of(folder / "a/") == place_of(folder / "link"));
  CHECK_FALSE(place_of(folder / "a/x") == place_of(folder / "a/y"));
  CHECK_FALSE(place_of("/dev/null").has_value());
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(folder / "a");
  CHECK(place_of("file") == place_of(folder / "a/file"));
  CHECK(place_of("new") == place_of(folder / "link/new"));
  std::filesystem::current_path(here);
}

TEST_CASE("what is in a folder is known by its name there") {
  const testing::scratch_folder folder("places");
  std::filesystem::create_directories(folder / "a/b");
  std::filesystem::create_symlink("a", folder / "link");
  CHECK(name_below(folder / "link/b/x", folder / "a") == std::string("b/x"));
  CHECK(name_below(folder / "a/new/x", folder / "link/new") == std::string("x"));
  CHECK(name_below(folder / "link", folder / "a") == std::string("."));
  CHECK_FALSE(name_below(folder / "x", folder / "a").has_value());
  CHECK_FALSE(name_below(folder / "ab", folder / "a").has_value());
}

TEST_CASE("the temporary name of a file is beside what a link names") {
  const testing::scratch_folder folder("places");
  std::filesystem::create_directories(folder / "a");
  std::ofstream(folder / "a/file") << "text";
  std::filesystem::create_symlink("a/file", folder / "link");
  CHECK(temporary_name(folder / "new") == std::filesystem::path((folder / "new").string() + ".part"));
  CHECK(temporary_name(folder / "link") ==
        std::filesystem::path(std::filesystem::canonical(folder / "a/file").string() + ".part"));
  CHECK_FALSE(temporary_name("/dev/null").has_value());
}

TEST_CASE("patterns have digits and any text") {
  CHECK(matches("mesh_#.vtu", "mesh_0012.vtu"));
  CHECK_FALSE(matches("mesh_#.vtu", "mesh_.vtu"));
  CHECK_FALSE(matches("mesh_#.vtu", "mesh_0.25.vtu"));
  CHECK_FALSE(matches("mesh_#.vtu", "mesh_1.vtu.old"));
  CHECK(matches("runs/*", "runs/a/b"));
  CHECK_FALSE(matches("runs/*", "runs"));
  CHECK(matches("*.blob", "piece_1.blob"));
  CHECK(matches("", ""));
}

} // namespace
} // namespace dovetail::app
