#include "commands.hpp"
#include "failure.hpp"
#include "file_checksums.hpp"
#include "mesh_files.hpp"
#include "run_figures.hpp"

#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/io/read_mesh.hpp"
#include "dovetail/io/streamed_validity.hpp"
#include "dovetail/io/zlib.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/parallel/serial.hpp"

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

namespace dovetail::app {
namespace {

std::string faults_of(const simplicial_mesh<3>& mesh) {
  return check_validity(mesh).text();
}
/// Of a shell, which may be open and have sheets that meet; crossing triangles are faults of it too.
std::string faults_of(const simplicial_mesh<2>& mesh) {
  const validity found = check_validity(mesh, {.closed_boundary = false, .non_manifold_sides = true});
  if (!found.valid())
    return found.text();
  const auto pairs = crossing_triangles(mesh.points, mesh.elements, {}, parallel::serial{});
  if (pairs.empty())
    return {};
  return std::to_string(pairs.size()) + " x crossing triangles (" + std::to_string(pairs.front().first) +
         " and " + std::to_string(pairs.front().second) + (pairs.size() > 1 ? ", ...)" : ")");
}

int print_validity(const std::string& faults, const std::string& file, int dimension, std::uint64_t elements,
                   std::uint64_t points) {
  if (!faults.empty()) {
    complain(file + ": not a valid mesh: " + faults);
    return exit_failure;
  }
  std::printf("%s: a valid mesh of %llu %s and %llu vertices\n", file.c_str(),
              static_cast<unsigned long long>(elements), dimension == 3 ? "tetrahedra" : "triangles",
              static_cast<unsigned long long>(points));
  return exit_ok;
}

int print_quality(const quality_statistics& quality, std::uint64_t points, int dimension,
                  const stats_options& options) {
  std::printf("%s: %llu vertices\n%s", options.mesh.c_str(), static_cast<unsigned long long>(points),
              quality_text(quality, dimension).c_str());
  if (!options.report.empty())
    write_quality_report(quality, dimension, static_cast<std::int64_t>(points), {}, options.report);
  return exit_ok;
}

/// Of tetrahedra in several files, one in memory at a time.
std::optional<int> check_streamed(const std::string& file) {
  io::streamed_validity found;
  if (!io::for_each_piece_file(file, io::zlib_expand, [&](const io::loaded_mesh& piece, const auto& path) {
        found.add(piece, path.filename().string());
      }))
    return std::nullopt;
  try {
    const std::string faults = found.faults();
    return print_validity(faults, file, 3, found.elements(), found.points());
  } catch (const input_error& problem) {
    throw input_error(file + ": " + problem.what());
  }
}

std::optional<int> measure_streamed(const stats_options& options) {
  quality_statistics quality;
  io::number_ranges points;
  if (!io::for_each_piece_file(options.mesh, io::zlib_expand, [&](const io::loaded_mesh& piece, const auto&) {
        quality.merge(measure_quality(piece.mesh), quality.elements);
        for (const global_id id : piece.node_ids)
          points.add(id);
      }))
    return std::nullopt;
  return print_quality(quality, points.count(), 3, options);
}

/// Calls `f` with the mesh in the file: tetrahedra, or triangles where it has none.
template <class F>
int with_mesh_of(const std::string& file, const F& f) {
  io::loaded_mesh loaded = io::read_mesh(file, io::zlib_expand);
  return is_of_triangles(loaded) ? f(take_triangles(std::move(loaded))) : f(loaded.mesh);
}

/// Whether the files of a run are as it wrote them.
int check_files(const std::string& report) {
  const report_files given = files_of_report(report);
  if (const std::string faults = faults_of(given); !faults.empty()) {
    complain(report + ": not as it was written: " + faults);
    return exit_failure;
  }
  std::printf("%s: %zu files are as they were written\n", report.c_str(), given.files.size());
  return exit_ok;
}

int check_mesh(const check_options& options) {
  if (const auto result = check_streamed(options.mesh))
    return *result;
  return with_mesh_of(options.mesh, [&]<int D>(const simplicial_mesh<D>& mesh) {
    return print_validity(faults_of(mesh), options.mesh, D, mesh.elements.size(), mesh.points.size());
  });
}

} // namespace

int run_check(const check_options& options) {
  if (options.mesh.empty() && options.report.empty())
    throw command_line_error("check: give a mesh file, or --report with the report of a run, or both");
  const int files = options.report.empty() ? exit_ok : check_files(options.report);
  const int mesh = options.mesh.empty() ? exit_ok : check_mesh(options);
  return files == exit_ok ? mesh : files;
}

int run_stats(const stats_options& options) {
  if (const auto result = measure_streamed(options))
    return *result;
  return with_mesh_of(options.mesh, [&]<int D>(const simplicial_mesh<D>& mesh) {
    return print_quality(measure_quality(mesh), mesh.points.size(), D, options);
  });
}

} // namespace dovetail::app
