/// @file
/// The library's pipeline with policies chosen at run time: instantiated here, once.
#pragma once

#include "any_background_mesher.hpp"
#include "any_geometry.hpp"
#include "any_policies.hpp"

#include "dovetail/pipeline/generate.hpp"

#include <type_traits>

namespace dovetail::app {

/// The policies of a run.
template <class Mesher>
struct policies_with {
  Mesher mesher;
  any_partitioner partitioner;
  any_improver improver;
  any_executor executor;
  any_background_mesher background_mesher = {}; ///< of D = 3
};
using chosen_policies = policies_with<any_mesher>;
using chosen_surface_policies = policies_with<any_surface_mesher>; ///< of D = 2

/// The policies of a run of D.
template <int D>
using policies_of = std::conditional_t<D == 3, chosen_policies, chosen_surface_policies>;

/// The library's parameters with these policies.
template <class Mesher>
auto composed(const policies_with<Mesher>& policies, const generate_options& options) {
  return parameters<Mesher, any_partitioner, any_improver, any_executor>{
      policies.mesher, policies.partitioner, policies.improver, policies.executor, options};
}

/// `generate<2>` with these policies.
generated<2> generate_mesh(const any_geometry& geometry, const any_sizing& size,
                           const chosen_surface_policies& policies, const generate_options& options);

/// `generate<3>` with these policies.
generate_result generate_mesh(const any_geometry& geometry, const any_sizing& size,
                              const chosen_policies& policies, const generate_options& options);

/// The two halves of both: the background mesh, which depends on neither partitioner nor improver nor
/// simplification, and the rest.
background_result<3> make_background_mesh(const any_geometry& geometry, const any_sizing& size,
                                          const chosen_policies& policies, const generate_options& options);
generate_result generate_mesh_from(const background_result<3>& background, const any_geometry& geometry,
                                   const chosen_policies& policies, const generate_options& options);
background_result<2> make_background_mesh(const any_geometry& geometry, const any_sizing& size,
                                          const chosen_surface_policies& policies,
                                          const generate_options& options);
generated<2> generate_mesh_from(const background_result<2>& background, const any_geometry& geometry,
                                const chosen_surface_policies& policies, const generate_options& options);

/// What `generate_mesh` would plan, without making anything but a first surface.
mesh_plan plan_generation(const any_geometry& geometry, const any_sizing& size,
                          const chosen_policies& policies, const generate_options& options);
mesh_plan plan_generation(const any_geometry& geometry, const any_sizing& size,
                          const chosen_surface_policies& policies, const generate_options& options);

} // namespace dovetail::app
