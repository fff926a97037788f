/// @file
/// From a background mesh to its parts: simplification and partition (paper, sections 3.3 and 3.4).
#pragma once

#include "dovetail/core/fields.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/mesh/background_mesh.hpp"
#include "dovetail/mesh/side_state.hpp"
#include "dovetail/pipeline/bound_parameters.hpp"

#include <cstddef>
#include <vector>

namespace dovetail {

/// A background mesh cut into parts, and what the steps after that need to know of how it came about.
template <int D>
struct divided_background {
  side_table<D> sides; ///< of the background mesh
  /// D = 3: the elements behind and in front of each surface triangle, or no_id.
  elements_at_triangles beside_surface;
  std::vector<double> weights;         ///< predicted elements, per coarse element
  std::vector<side_state> side_states; ///< by side: what the simplification decided
  decomposition pieces;                ///< the parts
  interface_angles angles;             ///< of the interfaces between the parts
  report simplification, partition;    ///< of the two steps

  /// All but the sides, which follow from the mesh.
  using fields = field_list<&divided_background::weights, &divided_background::side_states,
                            &divided_background::pieces, &divided_background::angles,
                            &divided_background::simplification, &divided_background::partition>;
};

/// Cuts a background mesh for a field of final sizes into about so many subdomains. Throws `mesh_error` for a
/// mesh that `require_valid` refuses, and what the rule, the partitioner and `decompose` throw.
/// Complexity: that of `simplify_coupled` and of the partitioner.
/// \param coarse the background mesh
/// \param size the final edge lengths, in the units of the model
/// \param subdomains how many are wanted
/// \param given rule, partitioner and options
template <int D, bound_parameters<D> Parameters>
divided_background<D> divide(const simplicial_background<D>& coarse, const any_sizing& size, int subdomains,
                             const Parameters& given);
template <int D, class Parameters>
divided_background<D> divide(const simplicial_background<D>& coarse, const any_sizing& size, int subdomains,
                             const Parameters& given) {
  return divide<D>(coarse, size, subdomains, bind_parameters<D>(given));
}

/// A background mesh without a volume: each solid is a part, and stands for its only element. Throws
/// `geometry_error` when the model has no solid or a solid's surface is open.
divided_background<3> leave_undivided(const surface_mesh& surface, const geometry_topology& topology);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/divide.ipp"
#endif
