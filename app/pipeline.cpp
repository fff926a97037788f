#include "pipeline.hpp"

#include "dovetail/pipeline/whole_background.hpp"

namespace dovetail::app {

generate_result generate_mesh(const any_geometry& geometry, const any_sizing& size,
                              const chosen_policies& policies, const generate_options& options) {
  return generate_from_background<3>(geometry, make_background_mesh(geometry, size, policies, options),
                                     composed(policies, options));
}

background_result<3> make_background_mesh(const any_geometry& geometry, const any_sizing& size,
                                          const chosen_policies& policies, const generate_options& options) {
  if (policies.background_mesher.meshes_whole_domains())
    return make_background_by(policies.background_mesher, geometry, size, composed(policies, options));
  return make_background<3>(geometry, size, composed(policies, options));
}

generate_result generate_mesh_from(const background_result<3>& background, const any_geometry& geometry,
                                   const chosen_policies& policies, const generate_options& options) {
  return generate_from_background<3>(geometry, background, composed(policies, options));
}

mesh_plan plan_generation(const any_geometry& geometry, const any_sizing& size,
                          const chosen_policies& policies, const generate_options& options) {
  return plan_background(geometry, size, composed(policies, options));
}

} // namespace dovetail::app
