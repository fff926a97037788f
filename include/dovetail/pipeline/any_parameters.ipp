/// @file
/// What `any_parameters.hpp` declares.
#pragma once

#include "dovetail/pipeline/any_parameters.hpp"

#include <string>

namespace dovetail {

#ifdef DOVETAIL_COMPILED
template any_mesher<2>::any_mesher(mesher::by_regions<remesh::patch_remesher>, std::string);
template any_mesher<3>::any_mesher(mesher::native, std::string);
template any_improver<2>::any_improver(improvement::native, std::string);
template any_improver<3>::any_improver(improvement::native, std::string);
template any_partitioner::any_partitioner(partition::greedy, std::string);
template any_executor::any_executor(parallel::serial, std::string);
template any_simplification_rule::any_simplification_rule(simplifier::paper, std::string);
template any_surface_mesher::any_surface_mesher(remesh::patch_remesher, std::string);
#endif

} // namespace dovetail
