#include "pipeline.hpp"

namespace dovetail::app {

generated<2> generate_mesh(const any_geometry& geometry, const any_sizing& size,
                           const chosen_surface_policies& policies, const generate_options& options) {
  return generate<2>(geometry, size, composed(policies, options));
}

mesh_plan plan_generation(const any_geometry& geometry, const any_sizing& size,
                          const chosen_surface_policies& policies, const generate_options& options) {
  return plan_background<2>(geometry, size, composed(policies, options));
}

} // namespace dovetail::app
