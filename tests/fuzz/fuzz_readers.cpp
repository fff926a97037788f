// Bytes that a fuzzer makes up, as files for one of the library's own readers: each is read or refused with a
// typed error, in bounded time and memory. `--reader=KIND` chooses the reader.
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/sizing_json.hpp"
#include "dovetail/files/zlib.hpp"
#include "dovetail/models/discrete/read.hpp"
#include "dovetail/models/plane/read.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

namespace {

using namespace dovetail;

std::function<void(const std::filesystem::path&)> reader_of(const std::string& kind) {
  if (kind == "msh" || kind == "vtu")
    return [](const auto& file) { io::read_mesh(file, io::zlib_expand, true); };
  if (kind == "svg")
    return [](const auto& file) { read_svg(file); };
  if (kind == "txt")
    return [](const auto& file) { read_polygons(file); };
  if (kind == "json")
    return [](const auto& file) { sizing::read_sizing(file, {.domain = {{0, 0, 0}, {1, 1, 1}}}); };
  return [](const auto& file) { read_triangles(file); };
}

std::filesystem::path file; ///< a link to `memory`: readers go by the name's ending
int memory = -1;
std::function<void(const std::filesystem::path&)> read_it;

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view option = "--reader=";
  for (int i = 1; i < *argc; ++i)
    if (const std::string_view given = (*argv)[i]; given.starts_with(option)) {
      const std::string kind(given.substr(option.size()));
      file = std::filesystem::temp_directory_path() /
             ("dovetail_fuzz_" + std::to_string(::getpid()) + "." + kind);
      read_it = reader_of(kind);
    }
  memory = ::memfd_create("input", 0);
  if (!read_it || memory < 0)
    std::abort();
  std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(memory), file);
  std::atexit([] { std::filesystem::remove(file); });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (::ftruncate(memory, 0) != 0 || ::pwrite(memory, data, size, 0) != static_cast<ssize_t>(size))
    std::abort();
  try {
    read_it(file);
  } catch (const error&) { // any other exception ends the fuzzer
  }
  return 0;
}
