/// @file
/// Ids of vertices and elements that are contiguous per rank. They follow from the ranks of the pieces, the
/// counts and the skeleton, so that every rank finds the same ones without asking another.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/skeleton_nodes.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/skeleton_index.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

/// What every rank knows of all: O(skeleton + pieces). The skeleton's points are its nodes where the mesh has
/// those in the middle of edges (mid_nodes.hpp).
struct rank_numbering {
  std::vector<local_id> rank_of_piece;         ///< a rank for each piece
  compressed_rows<local_id> pieces_of_rank;    ///< growing
  compressed_rows<local_id> ranks_at_point;    ///< per point of the skeleton, growing: the first is its owner
  std::vector<global_id> first_vertex;         ///< per rank, and the number of all vertices
  std::vector<global_id> first_element;        ///< per rank, and the number of all elements
  std::vector<global_id> point_ids;            ///< per point of the skeleton; -1 when no element has it
  std::vector<global_id> first_inner_of_piece; ///< id of each piece's first inner point
  std::vector<global_id> first_middle_of_piece;  ///< id of the first middle of each piece's inner edges
  std::vector<global_id> first_element_of_piece; ///< id of each piece's first element

  /// How many ranks there are.
  local_id ranks() const { return static_cast<local_id>(pieces_of_rank.size()); }
  /// The lowest rank that has an element at a point of the skeleton; no_id without any.
  local_id owner_of_point(local_id point) const {
    const auto at = ranks_at_point[point];
    return at.empty() ? no_id : at.front();
  }
};

namespace detail {

template <int D>
compressed_rows<local_id> ranks_at_points(const distributed_simplicial_mesh<D>& mesh,
                                          std::span<const local_id> rank_of_piece) {
  const auto& skeleton = mesh.skeleton;
  auto met = sorted_into_rows<local_id>(skeleton_nodes(mesh), [&](const auto& put) {
    for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
      for_each_node(mesh, skeleton.sides[s], [&](local_id v) {
        for (const local_id p : skeleton.subdomains[s])
          if (p != no_id)
            put(v, rank_of_piece[p]);
      });
  });
  compressed_rows<local_id> ranks;
  ranks.begins.reserve(met.begins.size());
  for (std::size_t v = 0; v < met.size(); ++v) {
    const std::span<local_id> row = met[v];
    sort_all(row);
    for (std::size_t i = 0; i < row.size(); ++i)
      if (i == 0 || row[i] != row[i - 1])
        ranks.items.push_back(row[i]);
    ranks.begins.push_back(ranks.items.size());
  }
  return ranks;
}

} // namespace detail

/// Numbers vertices and elements for `ranks` ranks, of which each piece has one: of a rank first the points
/// of the skeleton that it owns, growing, then the inner points of its pieces; then, of second-order
/// elements, the middles of the skeleton's edges that it owns, growing, and those of the inner edges of its
/// pieces. About linear in the skeleton. Throws `usage_error` when a piece has no rank, `mesh_error` when the
/// skeleton refers to what is not there.
/// \param mesh what `generate` or a redistribution makes
/// \param rank_of_piece one per piece, from 0; a redistribution gives it
/// \param ranks how many there are
template <int D>
rank_numbering number_by_ranks(const distributed_simplicial_mesh<D>& mesh,
                               std::vector<local_id> rank_of_piece, local_id ranks) {
  if (ranks < 1 || rank_of_piece.size() != mesh.counts.size())
    throw usage_error(std::to_string(rank_of_piece.size()) + " ranks of pieces, of " + std::to_string(ranks) +
                      " ranks, for " + std::to_string(mesh.counts.size()) + " pieces");
  for (std::size_t p = 0; p < rank_of_piece.size(); ++p)
    if (rank_of_piece[p] < 0 || rank_of_piece[p] >= ranks)
      throw usage_error("piece " + std::to_string(p) + " is given to rank " +
                        std::to_string(rank_of_piece[p]) + " of " + std::to_string(ranks));
  sides_by_subdomain<D>{mesh}; // checks the skeleton's references
  rank_numbering numbers;
  numbers.ranks_at_point = detail::ranks_at_points(mesh, rank_of_piece);
  numbers.pieces_of_rank = sorted_into_rows<local_id>(static_cast<std::size_t>(ranks), [&](const auto& put) {
    for (std::size_t p = 0; p < rank_of_piece.size(); ++p)
      put(rank_of_piece[p], static_cast<local_id>(p));
  });
  numbers.rank_of_piece = std::move(rank_of_piece);

  // Per rank: of the skeleton's points, and of the middles of its edges.
  std::vector<std::array<global_id, 2>> owned(static_cast<std::size_t>(ranks), {0, 0}), next_id = owned;
  const std::size_t nodes = skeleton_nodes(mesh);
  const auto is_middle = [&](std::size_t v) { return std::size_t{v >= mesh.skeleton.points.size()}; };
  for (std::size_t v = 0; v < nodes; ++v)
    if (const local_id owner = numbers.owner_of_point(static_cast<local_id>(v)); owner != no_id)
      ++owned[owner][is_middle(v)];
  numbers.first_vertex = {0};
  numbers.first_element = {0};
  numbers.first_inner_of_piece.resize(mesh.counts.size());
  numbers.first_middle_of_piece.resize(mesh.counts.size());
  numbers.first_element_of_piece.resize(mesh.counts.size());
  for (std::size_t q = 0; q < owned.size(); ++q) {
    global_id vertex = numbers.first_vertex.back();
    next_id[q][0] = vertex;
    vertex += owned[q][0];
    global_id element = numbers.first_element.back();
    for (const local_id piece : numbers.pieces_of_rank[q]) {
      const auto p = static_cast<std::size_t>(piece);
      numbers.first_inner_of_piece[p] = vertex;
      numbers.first_element_of_piece[p] = element;
      vertex += mesh.counts[p].inner_points;
      element += mesh.counts[p].elements;
    }
    next_id[q][1] = vertex;
    vertex += owned[q][1];
    for (const local_id piece : numbers.pieces_of_rank[q]) {
      const auto p = static_cast<std::size_t>(piece);
      numbers.first_middle_of_piece[p] = vertex;
      vertex += inner_nodes(mesh, p) - mesh.counts[p].inner_points;
    }
    numbers.first_vertex.push_back(vertex);
    numbers.first_element.push_back(element);
  }
  numbers.point_ids.assign(nodes, -1);
  for (std::size_t v = 0; v < nodes; ++v)
    if (const local_id owner = numbers.owner_of_point(static_cast<local_id>(v)); owner != no_id)
      numbers.point_ids[v] = next_id[owner][is_middle(v)]++;
  return numbers;
}

} // namespace dovetail::io
