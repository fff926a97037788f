#include "any_mesh_file.hpp"
#include "commands.hpp"
#include "failure.hpp"
#include "improvable_mesh.hpp"
#include "mesh_files.hpp"
#include "policies.hpp"
#include "quality_change.hpp"
#include "run_figures.hpp"

#include "dovetail/mesh/quality.hpp"

#include <cstdio>
#include <string>
#include <utility>

namespace dovetail::app {
namespace {

/// Improves the mesh of a file and says what that changed; the result is written before anything is printed.
template <int D>
void improve_and_report(const any_improver<D>& improve, io::loaded_mesh loaded,
                        const improve_options& options) {
  improvable_mesh<D> given(std::move(loaded));
  const quality_statistics before = measure_quality(given.mesh);
  const stopwatch clock;
  const report made = improve(given.mesh, given.frozen, any_sizing{});
  const double seconds = clock.seconds();
  const quality_statistics after = measure_quality(given.mesh);

  const io::loaded_mesh whole = std::move(given).put_back();
  write_mesh_file(whole, options.out);
  if (!options.report.empty())
    write_quality_report(after, D, static_cast<std::int64_t>(whole.mesh.points.size()), made, options.report);
  if (!options.quiet)
    print_change(D, before, after, seconds);
  for (const auto& warning : made.warnings)
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
}

} // namespace

int run_improve(const improve_options& options) {
  const auto improve_tetrahedra = make_improver<3>(options.preset, "--preset");
  check_can_write(options.out);
  io::loaded_mesh loaded = read_any_mesh(find_any_mesh(options.input));
  const std::string lost = left_out(loaded);
  warn_of_part(loaded, options.input);
  if (is_of_triangles(loaded))
    improve_and_report(make_improver<2>(options.preset, "--preset"), std::move(loaded), options);
  else
    improve_and_report(improve_tetrahedra, std::move(loaded), options);
  if (!lost.empty())
    std::fprintf(stderr, "warning: %s: not kept of %s: %s\n", options.out.c_str(), options.input.c_str(),
                 lost.c_str());
  return exit_ok;
}

} // namespace dovetail::app
