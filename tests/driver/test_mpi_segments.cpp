#include "mpi_segments.hpp"

#include "dovetail/parallel/owned_descriptor.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

/// A folder in place of that of the system, which has the segments of other runs.
class folder_of_segments {
public:
  folder_of_segments() {
    std::string name = (std::filesystem::temp_directory_path() / "segments_XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  folder_of_segments(const folder_of_segments&) = delete;
  folder_of_segments& operator=(const folder_of_segments&) = delete;
  ~folder_of_segments() { std::filesystem::remove_all(path_); }

  std::filesystem::path with(const std::string& name) const {
    std::ofstream(path_ / name) << std::string(4096, 'x');
    return path_ / name;
  }
  void remove_dead() const { remove_dead_mpi_segments(path_); }

private:
  std::filesystem::path path_;
};

TEST_CASE("a segment that no process has is removed, and no file of another name") {
  const folder_of_segments folder;
  const auto dead = folder.with("vader_segment.here.0.5a0d0001.3");
  const auto of_version_5 = folder.with("sm_segment.here.0.5a0d0001.3");
  const auto other = folder.with("vader.5a0d0001.3");
  folder.remove_dead();
  CHECK_FALSE(std::filesystem::exists(dead));
  CHECK_FALSE(std::filesystem::exists(of_version_5));
  CHECK(std::filesystem::exists(other));
}

TEST_CASE("a segment stays while a process has it open, or mapped") {
  const folder_of_segments folder;
  const auto segment = folder.with("vader_segment.here.0.5a0d0001.0");
  detail::owned_descriptor opened(::open(segment.c_str(), O_RDWR | O_CLOEXEC));
  REQUIRE(opened.get() >= 0);
  folder.remove_dead();
  CHECK(std::filesystem::exists(segment));
  void* const mapped = ::mmap(nullptr, 4096, PROT_READ, MAP_SHARED, opened.get(), 0);
  REQUIRE(mapped != MAP_FAILED);
  opened.close();
  folder.remove_dead();
  CHECK(std::filesystem::exists(segment));
  ::munmap(mapped, 4096);
  folder.remove_dead();
  CHECK_FALSE(std::filesystem::exists(segment));
}

TEST_CASE("a folder that is not there has no segments") {
  remove_dead_mpi_segments("/dev/shm/there_is_no_such_folder");
  CHECK(true);
}

} // namespace
} // namespace dovetail::app
