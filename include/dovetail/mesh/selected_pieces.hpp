/// @file
/// Some pieces of a distributed mesh as a distributed mesh of their own.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"

#include <span>

namespace dovetail {

/// The pieces with these numbers, and of the skeleton what bounds them. Piece k of the result is piece
/// `wanted[k]`, point by point and element by element; the points of the skeleton keep their order. A side
/// whose other piece is not among them has `no_id` there. In D = 3 such a side is of the boundary of the
/// domain or between two solids where it has a CAD face, else between two pieces of one solid.
///
/// Linear in the skeleton but for sorting its curves' edges. Throws `usage_error` when numbers do not grow or
/// there is no such piece, or when the mesh has mid-edge nodes: add these to the result.
/// \param mesh must have the pieces that are wanted; others are not loaded
/// \param wanted numbers of pieces, growing
template <int D>
distributed_simplicial_mesh<D> selected_pieces(const distributed_simplicial_mesh<D>& mesh,
                                               std::span<const local_id> wanted);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/selected_pieces.ipp"
#endif
