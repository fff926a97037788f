/// Writing and reading speed of the file formats: io [cells per axis (default 64)] [folder].
/// The mesh is a grid cube of 6 cells^3 elements in 64 subdomains, held in memory, so that the figures are
/// those of the formats. The pieces are loaded by copy, as from a spool file in the page cache.
#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "files/stacked_cubes.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace {

void print(const char* what, double elements, double seconds, double bytes) {
  std::printf("%-28s %8.3f s %8.2f M elements/s %8.1f MB/s\n", what, seconds, 1e-6 * elements / seconds,
              1e-6 * bytes / seconds);
}

} // namespace

int main(int argc, char** argv) {
  using namespace dovetail;
  const int cells = argc > 1 ? std::atoi(argv[1]) / 4 * 4 : 64;
  const auto folder = std::filesystem::path(argc > 2 ? argv[2] : std::filesystem::temp_directory_path()) /
                      "dovetail_benchmark_io";
  const auto mesh = testing::stacked_cubes{.cells = cells, .cuts = 4, .solids = 2}.distributed();
  const auto elements = static_cast<double>(io::number_globally(mesh).elements());
  std::printf("%.0f elements\n", elements);

  const stopwatch hash_clock;
  const auto hash = io::mesh_hash(mesh);
  print("hash", elements, hash_clock.seconds(), 0);
  const stopwatch validity_clock;
  const bool valid = io::check_distributed(mesh).valid();
  print(valid ? "validity" : "NOT VALID", elements, validity_clock.seconds(), 0);

  const auto write = [&](const char* what, const auto& writer) {
    const auto summary = writer(mesh, folder);
    print(what, elements, summary.seconds, summary.get("bytes"));
    const stopwatch clock;
    const auto read = io::read_mesh(folder);
    print("  read", elements, clock.seconds(), summary.get("bytes"));
    if (io::mesh_hash(read) != hash)
      std::printf("  READ BACK A DIFFERENT MESH\n");
    std::filesystem::remove_all(folder);
  };
  write("vtu", io::vtu_writer{});
  write("vtu, 2 files", io::vtu_writer{.files = 2});
  write("msh, whole", io::msh_writer{});
  write("msh, partitioned", io::partitioned_msh_writer{.stem = "mesh"});
  write("msh, partitioned, ghosts", io::partitioned_msh_writer{.ghosts = true, .stem = "mesh"});
  write("msh, text", io::msh_writer{.binary = false});
}
