#include "dovetail/core/output_file.hpp"
#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sys/stat.h>
#include <thread>

using namespace dovetail;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& path, std::string_view text) {
  output_file file(path);
  file.text(text);
  file.commit();
}

} // namespace

TEST_CASE("a file has its final name when it is complete, and none before") {
  const testing::scratch_folder here("output");
  const fs::path path = here / "figures.json";
  write(path, "old");
  {
    output_file abandoned(path);
    abandoned.text("half");
    CHECK(testing::file_content(path) == "old");
  }
  CHECK(testing::file_content(path) == "old");
  write(path, "new");
  CHECK(testing::file_content(path) == "new");
  CHECK(testing::file_count(here) == 1);
}

TEST_CASE("what is no plain file is written to, not replaced") {
  const testing::scratch_folder here("output");
  const fs::path pipe = here / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::string read;
  std::thread reader([&] { read = testing::file_content(pipe); });
  write(pipe, "through the pipe");
  reader.join();
  CHECK(read == "through the pipe");
  CHECK(fs::is_fifo(pipe));
  CHECK(testing::file_count(here) == 1);
}

TEST_CASE("a symbolic link stays, and the file that it names gets the content") {
  const testing::scratch_folder here("output");
  const fs::path target = here / "target", link = here / "link";
  write(target, "old");
  fs::create_symlink(target, link);
  write(link, "new");
  CHECK(fs::is_symlink(link));
  CHECK(testing::file_content(target) == "new");
  CHECK(testing::file_count(here) == 2);
}

TEST_CASE("a file that cannot be made is an io_error that names it") {
  const testing::scratch_folder here("output");
  CHECK_THROWS_WITH_AS(write(here / "none" / "file", ""), doctest::Contains("none/file"), io_error);
}
