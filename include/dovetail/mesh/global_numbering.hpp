/// @file
/// Global numbers of a distributed mesh: one exclusive scan over the counts of its pieces.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/mid_nodes.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::io {

/// Where the numbers of each piece start. Entry `pieces` of each array is the total.
struct global_numbering {
  std::vector<global_id> first_point;   ///< global number of a piece's first inner point
  std::vector<global_id> first_element; ///< global number of a piece's first element

  global_id points() const { return first_point.back(); }     ///< of the whole mesh
  global_id elements() const { return first_element.back(); } ///< of the whole mesh
};

/// O(pieces).
/// Throws nothing but for a lack of memory.
/// \param mesh what `generate` makes, or a reader
template <int D>
global_numbering number_globally(const distributed_simplicial_mesh<D>& mesh);

/// The same for nodes: `points()` counts those in the middle of edges too, and `first_point` is the number of
/// a piece's first own node.
template <int D>
global_numbering number_nodes(const distributed_simplicial_mesh<D>& mesh);

/// Loads a piece and checks it against its counts and the skeleton, so that consumers may index freely;
/// throws `mesh_error` naming the subdomain when they disagree. O(size of the piece).
template <int D>
simplicial_piece<D> load_checked(const distributed_simplicial_mesh<D>& mesh, local_id index);

/// The global number of node `i` of a piece.
template <int D>
global_id global_node(const piece_nodes<D>& nodes, const global_numbering& numbers, local_id piece,
                      local_id i) {
  const auto shared = static_cast<local_id>(nodes.shared().size());
  return i < shared ? nodes.shared()[i] : numbers.first_point[piece] + (i - shared);
}

/// The global number of point `i` of a piece.
template <int D>
global_id global_point(const simplicial_piece<D>& piece, const global_numbering& numbers, local_id i) {
  const auto shared = static_cast<local_id>(piece.skeleton_points.size());
  if (i < shared)
    return piece.skeleton_points[i];
  return numbers.first_point[piece.subdomain] + (i - shared);
}

#ifdef DOVETAIL_COMPILED
extern template global_numbering number_globally<2>(const distributed_simplicial_mesh<2>& mesh);
extern template global_numbering number_nodes<2>(const distributed_simplicial_mesh<2>& mesh);
extern template simplicial_piece<2> load_checked<2>(const distributed_simplicial_mesh<2>& mesh,
                                                    local_id index);
extern template global_numbering number_globally<3>(const distributed_simplicial_mesh<3>& mesh);
extern template global_numbering number_nodes<3>(const distributed_simplicial_mesh<3>& mesh);
extern template simplicial_piece<3> load_checked<3>(const distributed_simplicial_mesh<3>& mesh,
                                                    local_id index);
#endif

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/mesh/global_numbering.ipp"
#endif
