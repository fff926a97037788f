/// @file
/// The parameters of `generate<D>` with every policy behind its type-erased model: those that the compiled
/// library is an instantiation with, and of programs that choose policies while they run.
#pragma once

#include "dovetail/improver/any_improver.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/pipeline/parameters.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"

namespace dovetail {

/// All `parameters` whose mesher and improver are of dimension D convert to it.
template <int D>
using any_parameters = parameters<any_mesher<D>, any_partitioner, any_improver<D>, any_executor,
                                  any_simplification_rule, any_improver<3>, any_surface_mesher>;

} // namespace dovetail
