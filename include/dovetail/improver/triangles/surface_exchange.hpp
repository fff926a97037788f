/// @file
/// From a mesh of triangles to the improver's data and back, with frozen entities.
#pragma once

#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/triangles/surface_complex.hpp"

#include <array>
#include <vector>

namespace dovetail::improvement {

/// Without a host that says where the surface is smooth, a side whose triangles turn by more is fixed.
inline constexpr double default_feature_angle = 40;

namespace detail {

void require_triangles(const simplicial_mesh<2>& mesh);

} // namespace detail

/// The mesh, ready to be improved. Fixed are the sides listed as frozen, those with one or more than two
/// triangles, those between two tags and, without a host, the sharp ones. O(n log n); keeps references to
/// `size` and `host`. Throws `mesh_error` when the arrays are no oriented mesh or a frozen side is not in it.
surface_complex take_surface(const simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen,
                             const any_sizing& size, const surface_host& host,
                             double feature_angle = default_feature_angle);

/// Puts the result into `mesh` and, when `corner_uv` is given, its parameters there. Points that could not
/// move, and those without triangles, keep their numbers; a gap that is left before them stays a point
/// without triangles.
void give_back(const surface_complex& made, simplicial_mesh<2>& mesh,
               std::vector<std::array<vec2, 3>>* corner_uv = nullptr);

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/triangles/surface_exchange.ipp"
#endif
