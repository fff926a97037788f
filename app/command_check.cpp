#include "commands.hpp"
#include "failure.hpp"
#include "run_figures.hpp"

#include "dovetail/io/read_mesh.hpp"
#include "dovetail/mesh/validity.hpp"

#include <cstdio>

namespace dovetail::app {

int run_check(const check_options& options) {
  const io::loaded_mesh loaded = io::read_mesh(options.mesh);
  const validity found = check_validity(loaded.mesh);
  if (!found.valid()) {
    complain(options.mesh + ": not a valid mesh: " + found.text());
    return exit_failure;
  }
  std::printf("%s: a valid mesh of %zu tetrahedra and %zu vertices\n", options.mesh.c_str(),
              loaded.mesh.elements.size(), loaded.mesh.points.size());
  return exit_ok;
}

int run_stats(const stats_options& options) {
  const io::loaded_mesh loaded = io::read_mesh(options.mesh);
  const quality_statistics quality = measure_quality(loaded.mesh);
  std::printf("%s: %zu vertices\n%s", options.mesh.c_str(), loaded.mesh.points.size(),
              quality_text(quality).c_str());
  if (!options.report.empty())
    write_quality_report(quality, static_cast<std::int64_t>(loaded.mesh.points.size()), {}, options.report);
  return exit_ok;
}

} // namespace dovetail::app
