/// @file
/// What `simplify.hpp` declares.
#pragma once

#include "dovetail/simplification/simplify.hpp"

#include <span>

namespace dovetail {

#ifdef DOVETAIL_COMPILED
template simplification simplify<2>(const simplicial_mesh<2>& mesh, const mesh_duals<2>& duals,
                                    const simplifier::paper& rule, const contraction_bound& bound,
                                    std::span<const coupled_ridge<2>> coupled, const progress& on_progress);
template simplification simplify<3>(const simplicial_mesh<3>& mesh, const mesh_duals<3>& duals,
                                    const simplifier::paper& rule, const contraction_bound& bound,
                                    std::span<const coupled_ridge<3>> coupled, const progress& on_progress);
#endif

} // namespace dovetail
