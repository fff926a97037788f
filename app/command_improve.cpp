#include "commands.hpp"
#include "failure.hpp"
#include "improvable_mesh.hpp"
#include "mesh_files.hpp"
#include "model_source.hpp"
#include "policies.hpp"
#include "run_figures.hpp"

#include "dovetail/io/read_mesh.hpp"
#include "dovetail/io/zlib.hpp"
#include "dovetail/mesh/quality.hpp"

#include <cstdio>
#include <string>
#include <utility>

namespace dovetail::app {
namespace {

template <int D>
box3 bounds_of(const simplicial_mesh<D>& mesh) {
  box3 bounds;
  for (const vec3& p : mesh.points)
    bounds.include(p);
  return bounds;
}

/// How the quality of elements of one dimension is named and judged.
struct quality_terms {
  const char* count;
  const char* least;
  const char* most;
  int bad, low; ///< degrees
};
template <int D>
constexpr quality_terms terms =
    D == 3 ? quality_terms{"No. of tetrahedra", "Minimum dihedral angle (degrees)",
                           "Maximum dihedral angle (degrees)", 12, 24}
           : quality_terms{"No. of triangles", "Minimum angle (degrees)", "Maximum angle (degrees)", 15, 30};

void print_change(const quality_terms& name, const quality_statistics& before,
                  const quality_statistics& after, double seconds) {
  const auto row = [](const char* label, const char* format, auto old_value, auto new_value) {
    char values[2][40];
    std::snprintf(values[0], sizeof values[0], format, old_value);
    std::snprintf(values[1], sizeof values[1], format, new_value);
    std::printf("  %-32s %14s %14s\n", label, values[0], values[1]);
  };
  const auto per_million = [&](const char* word, int degrees) {
    const std::string label = std::string(word) + " (under " + std::to_string(degrees) + ") per million";
    row(label.c_str(), "%.1f", before.per_million_under(degrees), after.per_million_under(degrees));
  };
  std::printf("  %-32s %14s %14s\n", "", "before", "after");
  row(name.count, "%lld", static_cast<long long>(before.elements), static_cast<long long>(after.elements));
  row(name.least, "%.3f", before.min_wedge_deg, after.min_wedge_deg);
  row(name.most, "%.3f", before.max_wedge_deg, after.max_wedge_deg);
  per_million("Bad", name.bad);
  per_million("Low", name.low);
  std::printf("  %-32s %14.2f\n", "Seconds", seconds);
  if (seconds > 0)
    std::printf("  %-32s %14.0f\n", "Elements per second", static_cast<double>(before.elements) / seconds);
}

/// Improves the mesh of a file and says what that changed; the result is written before anything is printed.
template <int D>
void improve_and_report(const any_improver<D>& improve, io::loaded_mesh loaded, const given_sizes& sizes,
                        const improve_options& options) {
  improvable_mesh<D> given(std::move(loaded));
  const any_sizing size = sizes.field(bounds_of(given.mesh));
  const quality_statistics before = measure_quality(given.mesh);
  const stopwatch clock;
  const report made = improve(given.mesh, given.frozen, size);
  const double seconds = clock.seconds();
  const quality_statistics after = measure_quality(given.mesh);

  const io::loaded_mesh whole = std::move(given).put_back();
  write_mesh_file(whole, options.out);
  if (!options.report.empty())
    write_quality_report(after, static_cast<std::int64_t>(whole.mesh.points.size()), made, options.report);
  if (!options.quiet)
    print_change(terms<D>, before, after, seconds);
  for (const auto& warning : made.warnings)
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
}

} // namespace

int run_improve(const improve_options& options) {
  const auto improve_tetrahedra = make_improver<3>(options.preset, "--preset");
  const given_sizes sizes(options.sizing, options.size);
  check_can_write(options.out);
  io::loaded_mesh loaded = io::read_mesh(options.input, io::zlib_expand);
  const std::string lost = left_out(loaded);
  if (is_of_triangles(loaded))
    improve_and_report(make_improver<2>(options.preset, "--preset"), std::move(loaded), sizes, options);
  else
    improve_and_report(improve_tetrahedra, std::move(loaded), sizes, options);
  if (!lost.empty())
    std::fprintf(stderr, "warning: %s: not kept of %s: %s\n", options.out.c_str(), options.input.c_str(),
                 lost.c_str());
  return exit_ok;
}

} // namespace dovetail::app
