#include "dovetail/core/output_file.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sys/stat.h>
#include <thread>

using namespace dovetail;
namespace fs = std::filesystem;

namespace {

struct scratch {
  fs::path folder = fs::temp_directory_path() / ("dovetail_output_" + std::to_string(::getpid()));
  scratch() { fs::create_directories(folder); }
  scratch(const scratch&) = delete;
  scratch& operator=(const scratch&) = delete;
  ~scratch() { fs::remove_all(folder); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
  }
};

std::string content(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& path, std::string_view text) {
  output_file file(path);
  file.text(text);
  file.commit();
}

} // namespace

TEST_CASE("a file has its final name when it is complete, and none before") {
  const scratch here;
  const fs::path path = here.folder / "figures.json";
  write(path, "old");
  {
    output_file abandoned(path);
    abandoned.text("half");
    CHECK(content(path) == "old");
  }
  CHECK(content(path) == "old");
  write(path, "new");
  CHECK(content(path) == "new");
  CHECK(here.files() == 1);
}

TEST_CASE("what is no plain file is written to, not replaced") {
  const scratch here;
  const fs::path pipe = here.folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::string read;
  std::thread reader([&] { read = content(pipe); });
  write(pipe, "through the pipe");
  reader.join();
  CHECK(read == "through the pipe");
  CHECK(fs::is_fifo(pipe));
  CHECK(here.files() == 1);
}

TEST_CASE("a symbolic link stays, and the file that it names gets the content") {
  const scratch here;
  const fs::path target = here.folder / "target", link = here.folder / "link";
  write(target, "old");
  fs::create_symlink(target, link);
  write(link, "new");
  CHECK(fs::is_symlink(link));
  CHECK(content(target) == "new");
  CHECK(here.files() == 2);
}

TEST_CASE("a file that cannot be made is an io_error that names it") {
  const scratch here;
  CHECK_THROWS_WITH_AS(write(here.folder / "none" / "file", ""), doctest::Contains("none/file"), io_error);
}
