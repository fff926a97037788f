/// @file
/// From a mesh to the improver's data and back, with frozen entities.
#pragma once

#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/tetrahedra/curve_order.hpp"
#include "dovetail/improver/tetrahedra/tet_complex.hpp"

namespace dovetail::improvement {

/// In which order the complex holds points and elements: as they come (`as_given`), or next to each other in
/// memory what is next to each other in space (`along_curve`, see curve_order.hpp), which is faster.
enum class layout { as_given, along_curve };

/// Takes the mesh's arrays over. Throws `mesh_error` when they are not a mesh or a frozen side is not in it;
/// the mesh is then in an unspecified state.
tet_complex take_mesh(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen,
                      layout order = layout::as_given);

/// Gives the arrays back without gaps. Elements and points come in the complex's order, but fixed points, and
/// those without elements, keep the numbers they came with: free ones take the others in turn. Tags stay with
/// their elements. Leaves the complex empty.
void give_back(tet_complex& complex, simplicial_mesh<3>& mesh);

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/improver/tetrahedra/mesh_exchange.ipp"
#endif
