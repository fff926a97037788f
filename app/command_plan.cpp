#include "commands.hpp"
#include "failure.hpp"
#include "model_source.hpp"
#include "output.hpp"
#include "run_figures.hpp"
#include "run_setup.hpp"
#include "terminal_progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dovetail::app {
namespace {

/// Measured on one 2.5 GHz core with TetGen and the improver's preset `fine`; the order of magnitude
/// elsewhere.
constexpr double elements_per_second_and_worker = 100'000;
/// Of a worker, per element of its subdomain, TetGen being the hungriest; and of the parent, per element of
/// the skeleton.
constexpr double worker_bytes_per_element = 900;
constexpr double parent_bytes_per_boundary_triangle = 400;
constexpr double bytes_of_program = 60e6;

/// Triangles on the boundaries of equal pieces that are about cubes, in a mesh of so many elements.
double predicted_boundary_triangles(double elements, int subdomains) {
  const double per_piece = elements / subdomains;
  return 0.5 * subdomains * 6 * 2 * std::pow(per_piece / 6, 2.0 / 3);
}

} // namespace

int run_plan(const plan_options& options) {
  const chosen_policies policies = make_policies(options.mesh);
  generate_options parameters = make_generate_options(options.mesh);
  if (!options.report.empty())
    check_can_create(options.report);
  terminal_progress lines(stderr);
  lines.update("geometry", 0, 0);
  const model_source source = load_model(options.mesh.model);
  parameters.on_progress = lines.callbacks();
  const mesh_plan plan = plan_generation(source.geometry, source.size, policies, parameters);
  lines.finish();

  plan_figures figures;
  figures.model = source.name;
  figures.elements = plan.predicted_elements;
  figures.relative_error = plan.relative_error;
  figures.subdomains = plan.subdomains;
  figures.coarsening = plan.coarse_scale;
  figures.workers = policies.executor.workers();
  figures.seconds = plan.predicted_elements / (elements_per_second_and_worker * figures.workers);
  figures.worker_bytes =
      bytes_of_program + worker_bytes_per_element * plan.predicted_elements / plan.subdomains;
  figures.parent_bytes =
      bytes_of_program + parent_bytes_per_boundary_triangle *
                             predicted_boundary_triangles(plan.predicted_elements, plan.subdomains);
  figures.disk_bytes = plan.predicted_elements * bytes_per_element(make_formats<3>({}, 0));
  std::fputs(plan_text(figures).c_str(), stdout);
  if (!options.report.empty())
    write_plan(figures, options.report);
  return exit_ok;
}

} // namespace dovetail::app
