#include "commands.hpp"
#include "failure.hpp"
#include "mesh_files.hpp"
#include "model_source.hpp"
#include "policies.hpp"
#include "run_figures.hpp"

#include "dovetail/io/read_mesh.hpp"
#include "dovetail/mesh/adjacency.hpp"

#include <cstdio>

namespace dovetail::app {
namespace {

box3 bounds_of(const simplicial_mesh<3>& mesh) {
  box3 bounds;
  for (const vec3& p : mesh.points)
    bounds.include(p);
  return bounds;
}

/// The sides between tetrahedra of different regions; they must stay.
frozen_entities<3> material_interfaces(const simplicial_mesh<3>& mesh) {
  frozen_entities<3> frozen;
  if (mesh.tags.empty())
    return frozen;
  const auto tag = [&](local_id element) { return mesh.tags[static_cast<std::size_t>(element)]; };
  const side_table<3> sides = build_sides(mesh);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [first, second] = sides.elements[s];
    if (second != no_id && tag(first) != tag(second))
      frozen.sides.push_back(sides.vertices[s]);
  }
  return frozen;
}

void print_change(const quality_statistics& before, const quality_statistics& after, double seconds) {
  const auto row = [](const char* label, const char* format, auto old_value, auto new_value) {
    char values[2][40];
    std::snprintf(values[0], sizeof values[0], format, old_value);
    std::snprintf(values[1], sizeof values[1], format, new_value);
    std::printf("  %-32s %14s %14s\n", label, values[0], values[1]);
  };
  std::printf("  %-32s %14s %14s\n", "", "before", "after");
  row("No. of tetrahedra", "%lld", static_cast<long long>(before.elements),
      static_cast<long long>(after.elements));
  row("Minimum dihedral angle (degrees)", "%.3f", before.min_wedge_deg, after.min_wedge_deg);
  row("Maximum dihedral angle (degrees)", "%.3f", before.max_wedge_deg, after.max_wedge_deg);
  row("Bad (under 12) per million", "%.1f", before.per_million_under(12), after.per_million_under(12));
  row("Low (under 24) per million", "%.1f", before.per_million_under(24), after.per_million_under(24));
  std::printf("  %-32s %14.2f\n", "Seconds", seconds);
  if (seconds > 0)
    std::printf("  %-32s %14.0f\n", "Elements per second", static_cast<double>(before.elements) / seconds);
}

} // namespace

int run_improve(const improve_options& options) {
  const any_improver improve = make_improver(options.preset);
  check_can_write(options.out);
  io::loaded_mesh loaded = io::read_mesh(options.input);
  const any_sizing size = load_sizing(options.sizing, options.size, bounds_of(loaded.mesh));

  const quality_statistics before = measure_quality(loaded.mesh);
  const frozen_entities<3> frozen = material_interfaces(loaded.mesh);
  const stopwatch clock;
  const report made = improve(loaded.mesh, frozen, size);
  const double seconds = clock.seconds();
  const quality_statistics after = measure_quality(loaded.mesh);

  write_mesh_file(loaded, options.out);
  if (!options.report.empty())
    write_quality_report(after, static_cast<std::int64_t>(loaded.mesh.points.size()), made, options.report);
  if (!options.quiet)
    print_change(before, after, seconds);
  for (const auto& warning : made.warnings)
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  return exit_ok;
}

} // namespace dovetail::app
