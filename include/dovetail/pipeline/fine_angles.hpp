/// @file
/// The interface angles of a realized decomposition, and where small ones are.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/decomposition/local_repartition.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/realize.hpp"

#include <cstdint>
#include <vector>

namespace dovetail::detail {

/// Of the edges at which a dihedral may be small: not those inside of a plane interface face, nor those
/// inside of a CAD face.
std::vector<std::uint32_t> half_edges_that_matter(const realized<3>& skeleton);

/// In tasks, each with a share of the triangles and edges.
interface_angles fine_interface_angles(const realized<3>& skeleton, const simplicial_background<3>&,
                                       const divided_background<3>& divided, const any_sizing& size,
                                       const wanted_angles& wanted, const any_executor& run,
                                       const progress& on_progress = {});

/// The corners are those between the first edges of the lines at each vertex; the faces are all edges of the
/// lines between subdomains that are on no CAD curve.
interface_angles fine_interface_angles(const realized<2>& skeleton, const simplicial_background<2>& mesh,
                                       const divided_background<2>& divided, const any_sizing&,
                                       const wanted_angles& wanted, const any_executor& run,
                                       const progress& = {});

/// The coarse sides of small angles of a realized decomposition that are not forced, each set of sides once
/// however many edges of the lines have a small angle there.
places_of_angles places_of_small_angles(const realized<3>& skeleton, const interface_angles& angles);
/// None that interfaces could keep clear of.
inline places_of_angles places_of_small_angles(const realized<2>&, const interface_angles&) {
  return {};
}

} // namespace dovetail::detail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/fine_angles.ipp"
#endif
