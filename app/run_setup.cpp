#include "run_setup.hpp"

#include "failure.hpp"
#include "policies.hpp"
#include "surface_policies.hpp"

#include <cmath>
#include <string>

namespace dovetail::app {

chosen_policies make_policies(const mesh_options& options) {
  any_mesher mesher = make_mesher(options.mesher);
  any_executor executor =
      make_executor(options.executor, options.workers, mesher.name(), mesher.actual_traits());
  return {std::move(mesher), make_partitioner(options.partitioner), make_improver(options.improver),
          std::move(executor), make_background_mesher(options.background_mesher)};
}

chosen_surface_policies make_surface_policies(const mesh_options& options) {
  if (make_background_mesher(options.background_mesher).meshes_whole_domains())
    throw command_line_error(
        "--background-mesher: with --dimension 2 there is no volume to mesh; use native");
  any_surface_mesher mesher = make_surface_mesher(options.mesher);
  any_executor executor =
      make_executor(options.executor, options.workers, mesher.name(), mesher.actual_traits());
  return {std::move(mesher), make_partitioner(options.partitioner), make_improver(options.improver),
          std::move(executor)};
}

generate_options make_generate_options(const mesh_options& options) {
  generate_options result;
  if (options.subdomains) {
    if (*options.subdomains < 1)
      throw command_line_error("--subdomains: " + std::to_string(*options.subdomains) +
                               " is not a number of pieces");
    result.subdomains = *options.subdomains;
  }
  if (options.coarsening) {
    if (!(*options.coarsening >= 1) || !std::isfinite(*options.coarsening))
      throw command_line_error("--coarsening: " + std::to_string(*options.coarsening) + " is not 1 or more");
    result.coarse_scale = *options.coarsening;
  }
  return result;
}

} // namespace dovetail::app
