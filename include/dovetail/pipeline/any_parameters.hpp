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
#ifdef DOVETAIL_COMPILED
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/mesher/native.hpp"

#include <string>
#endif

namespace dovetail {

/// All `parameters` whose mesher and improver are of dimension D convert to it.
template <int D>
using any_parameters = parameters<any_mesher<D>, any_partitioner, any_improver<D>, any_executor,
                                  any_simplification_rule, any_improver<3>, any_surface_mesher>;

#ifdef DOVETAIL_COMPILED
// The default policies behind their types; each of these holds the whole of one.
extern template any_mesher<2>::any_mesher(mesher::by_regions<remesh::patch_remesher>, std::string);
extern template any_mesher<3>::any_mesher(mesher::native, std::string);
extern template any_improver<2>::any_improver(improvement::native, std::string);
extern template any_improver<3>::any_improver(improvement::native, std::string);
extern template any_partitioner::any_partitioner(partition::greedy, std::string);
extern template any_executor::any_executor(parallel::serial, std::string);
extern template any_simplification_rule::any_simplification_rule(simplifier::paper, std::string);
extern template any_surface_mesher::any_surface_mesher(remesh::patch_remesher, std::string);
#endif

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/any_parameters.ipp"
#endif
