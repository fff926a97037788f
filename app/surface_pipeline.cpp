#include "pipeline.hpp"

namespace dovetail::app {

generated<2> generate_mesh(const any_geometry& geometry, const any_sizing& size,
                           const chosen_surface_policies& policies, const generate_options& options) {
  return generate_from_background<2>(geometry, make_background_mesh(geometry, size, policies, options),
                                     composed(policies, options));
}

background_result<2> make_background_mesh(const any_geometry& geometry, const any_sizing& size,
                                          const chosen_surface_policies& policies,
                                          const generate_options& options) {
  return make_background<2>(geometry, size, composed(policies, options));
}

generated<2> generate_mesh_from(const background_result<2>& background, const any_geometry& geometry,
                                const chosen_surface_policies& policies, const generate_options& options) {
  return generate_from_background<2>(geometry, background, composed(policies, options));
}

mesh_plan plan_generation(const any_geometry& geometry, const any_sizing& size,
                          const chosen_surface_policies& policies, const generate_options& options) {
  return plan_background<2>(geometry, size, composed(policies, options));
}

} // namespace dovetail::app
