/// @file
/// The library's pipeline with policies chosen at run time.
#pragma once

#include "dovetail/mesher/any_line_keeping_mesher.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/pipeline/whole_background.hpp"

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
};

/// The library's parameters with these policies.
template <int D>
any_parameters<D> composed(const policies_of<D>& policies, const generate_options& options) {
  return {policies.mesher, policies.partitioner, policies.improver, policies.executor,
          options,         policies.simplifier};
}

/// The background mesh, which depends on neither partitioner nor improver nor simplification.
template <int D>
background_result<D> make_background_mesh(const any_geometry& geometry, const any_sizing& size,
                                          const policies_of<D>& policies, const generate_options& options) {
  if constexpr (D == 3)
    if (policies.background_mesher)
      return make_background_by(policies.background_mesher, geometry, size, composed(policies, options));
  return make_background<D>(geometry, size, composed(policies, options));
}

} // namespace dovetail::app
