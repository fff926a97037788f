#include "commands.hpp"
#include "failure.hpp"
#include "model_source.hpp"
#include "output_formats.hpp"
#include "resolved_walls.hpp"
#include "run_figures.hpp"
#include "run_setup.hpp"
#include "sizes_for_elements.hpp"
#include "stage_figures.hpp"
#include "suppression.hpp"
#include "terminal_progress.hpp"
#include "touching_faces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dovetail::app {
namespace {

/// What a run costs, by elements of a dimension. Measured on one 2.5 GHz core with the improver's preset
/// `fine`, and TetGen in D = 3; the order of magnitude elsewhere.
struct run_costs {
  double elements_per_second_and_worker;
  double worker_bytes_per_element; ///< of its subdomain
  double parent_bytes_per_side;    ///< of the skeleton
};
template <int D>
constexpr run_costs costs = D == 3 ? run_costs{100'000, 250, 400} : run_costs{150'000, 400, 400};
constexpr double bytes_of_program = 60e6;

/// Sides on the boundaries of equal pieces that are about cubes or squares, in a mesh of so many elements.
template <int D>
double predicted_skeleton_sides(double elements, int subdomains) {
  const double per_piece = elements / subdomains;
  return D == 3 ? 0.5 * subdomains * 6 * 2 * std::pow(per_piece / 6, 2.0 / 3)
                : 0.5 * subdomains * 4 * std::sqrt(per_piece / 2);
}

template <int D>
int plan_run(const plan_options& options) {
  const policies_of<D> policies = make_policies_of<D>(options.mesh);
  const generate_options given = make_generate_options(options.mesh);
  generate_options parameters = given;
  touching_faces touching(options.mesh.model, D);
  suppression details(touching.options(), D);
  terminal_progress lines(stderr);
  lines.update("geometry", 0, 0);
  parameters.on_progress = lines.callbacks();
  const auto prepare = [&] {
    parameters.undivided_elements = given.undivided_elements; // not of another try
    model_source source = load_model(touching.options(), D, policies.executor);
    resolve_walls(source, touching.options(), policies, parameters);
    scale_to_elements(source, touching.options(), policies, parameters);
    details.apply(source);
    return source;
  };
  model_source source = touching.prepared(prepare);
  const mesh_plan plan = touching.meshed(source, prepare, [&] {
    return details.retried(
        source, [&] { return plan_generation<D>(source.geometry, source.size, policies, parameters); });
  });
  lines.finish();

  plan_figures figures;
  figures.dimension = D;
  figures.model = source.name;
  figures.elements = plan.predicted_elements;
  figures.relative_error = plan.relative_error;
  figures.subdomains = plan.subdomains;
  figures.coarsening = plan.coarse_scale;
  figures.workers = policies.executor.workers();
  const int busy_workers = std::min(figures.workers, figures.subdomains);
  figures.seconds = plan.predicted_elements / (costs<D>.elements_per_second_and_worker * busy_workers);
  figures.worker_bytes =
      bytes_of_program + costs<D>.worker_bytes_per_element * plan.predicted_elements / plan.subdomains;
  figures.parent_bytes =
      bytes_of_program +
      costs<D>.parent_bytes_per_side * predicted_skeleton_sides<D>(plan.predicted_elements, plan.subdomains);
  figures.disk_bytes = plan.predicted_elements * bytes_per_element(make_formats<D>(options.mesh));
  collect_warnings(source.summary, figures.warnings);
  std::fputs(plan_text(figures).c_str(), stdout);
  if (!options.report.empty())
    write_plan(figures, options.report);
  return exit_ok;
}

} // namespace

int run_plan(const plan_options& options) {
  return options.mesh.dimension == 3 ? plan_run<3>(options) : plan_run<2>(options);
}

} // namespace dovetail::app
