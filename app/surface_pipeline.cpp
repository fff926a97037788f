#include "pipeline.hpp"

namespace dovetail::app {

generated<2> generate_mesh(const any_geometry& geometry, const any_sizing& size,
                           const chosen_surface_policies& policies, const generate_options& options) {
  const parameters<any_surface_mesher, any_partitioner, any_improver, any_executor> given{
      policies.mesher, policies.partitioner, policies.improver, policies.executor, options};
  return generate<2>(geometry, size, given);
}

} // namespace dovetail::app
