/// @file
/// The library's pipeline with policies chosen at run time.
#pragma once

#include "dovetail/mesher/any_line_keeping_mesher.hpp"
#include "dovetail/pipeline/any_parameters.hpp"
#include "dovetail/pipeline/generate.hpp"

#include <functional>

namespace dovetail::app {

/// The policies of a run of D.
template <int D>
struct policies_of {
  any_mesher<D> mesher;
  any_partitioner partitioner;
  any_improver<D> improver;
  any_executor executor;
  any_line_keeping_mesher background_mesher = {}; ///< of D = 3
  any_simplification_rule simplifier = simplifier::paper{};
  any_surface_mesher surface_mesher = {};
  any_improver<3> background_improver = {}; ///< the library's own where there is none
};

/// The library's parameters with these policies; a background mesher is not among them.
template <int D>
any_parameters<D> composed(const policies_of<D>& policies, const generate_options& options);

/// The two halves of `generate`: the background mesh, which depends on neither partitioner nor improver nor
/// simplification, and the rest.
template <int D>
background_result<D> make_background_mesh(const any_geometry& geometry, const any_sizing& size,
                                          const policies_of<D>& policies, const generate_options& options);
template <int D>
generated<D> generate_mesh_from(const background_result<D>& background, const any_geometry& geometry,
                                const policies_of<D>& policies, const generate_options& options);

/// `generate` with the fine surface divided by planes in place of a background mesh: `subdomains` of the
/// options is how many are wanted; without it the default of `baselines::recursive_bisection` counts faces.
generated<3> generate_by_bisection(const any_geometry& geometry, const any_sizing& size,
                                   const policies_of<3>& policies, const generate_options& options);

/// A fine mesh of each solid as a whole, partitioned into `subdomains` of the options, without it into parts
/// of the default size of `baselines::generate_by_fine_partition`, which are improved.
generated<3> generate_by_fine_partition(const any_geometry& geometry, const any_sizing& size,
                                        const policies_of<3>& policies, const generate_options& options);

/// What would be planned, without making anything but a first surface.
template <int D>
mesh_plan plan_generation(const any_geometry& geometry, const any_sizing& size,
                          const policies_of<D>& policies, const generate_options& options);
/// The same for the size times any factor.
template <int D>
std::function<mesh_plan(double factor)>
plan_multiples_of(const any_geometry& geometry, const any_sizing& size, const policies_of<D>& policies,
                  const generate_options& options);

} // namespace dovetail::app
