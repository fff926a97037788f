/// @file
/// A part of a coarse skeleton, to look at what a local change makes of it, or to make some pieces, without
/// the rest.
#pragma once

#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/mesh/coarse_skeleton.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace dovetail {

/// The regions and interface faces of a skeleton that have one of the given points, whole and as they are in
/// it, with all lines between their points. At these points it is as complete as the skeleton. Linear.
/// \param skeleton of the decomposed surface or volume
/// \param surface the coarse surface that the regions are of
/// \param is_wanted per point of the background mesh
coarse_skeleton part_at_points(coarse_skeleton skeleton, const surface_mesh& surface,
                               const std::vector<bool>& is_wanted);

/// These points, and those that share an element with one. Linear.
/// \param elements of the background mesh
/// \param points per point whether it is one of them
template <int D>
std::vector<bool> points_around(const std::vector<simplex<D>>& elements, const std::vector<bool>& points) {
  std::vector<bool> around = points;
  for (const simplex<D>& element : elements)
    if (std::any_of(element.begin(), element.end(), [&](local_id v) { return points[v]; }))
      for (const local_id v : element)
        around[v] = true;
  return around;
}

/// The points of some subdomains and of all that touch these, so that each of their interfaces is there as a
/// whole, and of elements that are nearer to theirs than half the size of these, also across a gap: what may
/// cross their boundaries. About n log n.
/// \param mesh the background mesh
/// \param subdomain_of_element per element its subdomain
/// \param wanted subdomains, growing
std::vector<bool> points_with_surroundings(const simplicial_mesh<3>& mesh,
                                           std::span<const local_id> subdomain_of_element,
                                           std::span<const local_id> wanted);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/skeleton_part.ipp"
#endif
