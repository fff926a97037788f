#include "commands.hpp"
#include "failure.hpp"
#include "mesh_files.hpp"
#include "run_figures.hpp"

#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/io/read_mesh.hpp"
#include "dovetail/io/zlib.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/parallel/serial.hpp"

#include <cstdio>
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

template <int D>
int check_mesh(const simplicial_mesh<D>& mesh, const std::string& file) {
  if (const std::string faults = faults_of(mesh); !faults.empty()) {
    complain(file + ": not a valid mesh: " + faults);
    return exit_failure;
  }
  std::printf("%s: a valid mesh of %zu %s and %zu vertices\n", file.c_str(), mesh.elements.size(),
              D == 3 ? "tetrahedra" : "triangles", mesh.points.size());
  return exit_ok;
}

template <int D>
int print_quality(const simplicial_mesh<D>& mesh, const stats_options& options) {
  const quality_statistics quality = measure_quality(mesh);
  std::printf("%s: %zu vertices\n%s", options.mesh.c_str(), mesh.points.size(),
              quality_text(quality, D).c_str());
  if (!options.report.empty())
    write_quality_report(quality, static_cast<std::int64_t>(mesh.points.size()), {}, options.report);
  return exit_ok;
}

/// Calls `f` with the mesh in the file: tetrahedra, or triangles where it has none.
template <class F>
int with_mesh_of(const std::string& file, const F& f) {
  io::loaded_mesh loaded = io::read_mesh(file, io::zlib_expand);
  return is_of_triangles(loaded) ? f(take_triangles(std::move(loaded))) : f(loaded.mesh);
}

} // namespace

int run_check(const check_options& options) {
  return with_mesh_of(options.mesh, [&](const auto& mesh) { return check_mesh(mesh, options.mesh); });
}

int run_stats(const stats_options& options) {
  return with_mesh_of(options.mesh, [&](const auto& mesh) { return print_quality(mesh, options); });
}

} // namespace dovetail::app
