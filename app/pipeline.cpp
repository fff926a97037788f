#include "pipeline.hpp"

#include "dovetail/experiments/baselines/generate_bisected.hpp"
#include "dovetail/experiments/baselines/generate_by_fine_partition.hpp"
#include "dovetail/pipeline/whole_background.hpp"

#include <cstddef>

namespace dovetail::app {

template <int D>
any_parameters<D> composed(const policies_of<D>& policies, const generate_options& options) {
  any_parameters<D> given{policies.mesher, policies.partitioner, policies.improver, policies.executor,
                          options,         policies.simplifier};
  given.mesh_surface = policies.surface_mesher;
  if (policies.background_improver)
    given.improve_background = policies.background_improver;
  return given;
}

template <int D>
background_result<D> make_background_mesh(const any_geometry& geometry, const any_sizing& size,
                                          const policies_of<D>& policies, const generate_options& options) {
  if constexpr (D == 3)
    if (policies.background_mesher)
      return make_background_by(policies.background_mesher, geometry, size, composed(policies, options));
  return make_background<D>(geometry, size, composed(policies, options));
}

template <int D>
generated<D> generate_mesh_from(const background_result<D>& background, const any_geometry& geometry,
                                const policies_of<D>& policies, const generate_options& options) {
  return generate_from_background<D>(geometry, background, composed(policies, options));
}

generated<3> generate_by_bisection(const any_geometry& geometry, const any_sizing& size,
                                   const policies_of<3>& policies, const generate_options& options) {
  baselines::recursive_bisection bisect{.mesh_interface = policies.surface_mesher};
  if (options.subdomains > 0) {
    bisect.most_faces = 0;
    bisect.most_subdomains = static_cast<std::size_t>(options.subdomains);
  }
  return baselines::generate_bisected(geometry, size, composed(policies, options), bisect);
}

generated<3> generate_by_fine_partition(const any_geometry& geometry, const any_sizing& size,
                                        const policies_of<3>& policies, const generate_options& options) {
  return baselines::generate_by_fine_partition(geometry, size, composed(policies, options));
}

template <int D>
mesh_plan plan_generation(const any_geometry& geometry, const any_sizing& size,
                          const policies_of<D>& policies, const generate_options& options) {
  return plan_background<D>(geometry, size, composed(policies, options));
}

template <int D>
std::function<mesh_plan(double factor)>
plan_multiples_of(const any_geometry& geometry, const any_sizing& size, const policies_of<D>& policies,
                  const generate_options& options) {
  return plan_multiples<D>(geometry, size, composed(policies, options));
}

template any_parameters<2> composed(const policies_of<2>&, const generate_options&);
template any_parameters<3> composed(const policies_of<3>&, const generate_options&);
template background_result<2> make_background_mesh(const any_geometry&, const any_sizing&,
                                                   const policies_of<2>&, const generate_options&);
template background_result<3> make_background_mesh(const any_geometry&, const any_sizing&,
                                                   const policies_of<3>&, const generate_options&);
template generated<2> generate_mesh_from(const background_result<2>&, const any_geometry&,
                                         const policies_of<2>&, const generate_options&);
template generated<3> generate_mesh_from(const background_result<3>&, const any_geometry&,
                                         const policies_of<3>&, const generate_options&);
template mesh_plan plan_generation(const any_geometry&, const any_sizing&, const policies_of<2>&,
                                   const generate_options&);
template mesh_plan plan_generation(const any_geometry&, const any_sizing&, const policies_of<3>&,
                                   const generate_options&);
template std::function<mesh_plan(double)> plan_multiples_of(const any_geometry&, const any_sizing&,
                                                            const policies_of<2>&, const generate_options&);
template std::function<mesh_plan(double)> plan_multiples_of(const any_geometry&, const any_sizing&,
                                                            const policies_of<3>&, const generate_options&);

} // namespace dovetail::app
