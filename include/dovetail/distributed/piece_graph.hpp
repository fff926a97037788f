/// @file
/// The graph of a mesh's pieces, and what a distribution of them to ranks amounts to.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/distributed/concepts.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// A node per piece, weighing its elements, an edge where pieces have sides in common, weighing their number;
/// positions are mean places of the points on a piece's boundary. O(skeleton log pieces).
template <int D>
csr_graph piece_graph(const distributed_simplicial_mesh<D>& mesh) {
  csr_graph graph;
  const std::size_t pieces = mesh.counts.size();
  std::vector<std::map<local_id, double>> rows(pieces);
  std::vector<double> points(pieces, 0.0);
  graph.positions.resize(pieces);
  for (std::size_t s = 0; s < mesh.skeleton.sides.size(); ++s) {
    const auto [behind, front] = mesh.skeleton.subdomains[s];
    for (const local_id p : {behind, front})
      for (std::size_t k = 0; p != no_id && k < static_cast<std::size_t>(D); ++k) {
        graph.positions[p] += mesh.skeleton.points[mesh.skeleton.sides[s][k]];
        points[p] += 1;
      }
    if (front == no_id || front == behind)
      continue;
    rows[behind][front] += 1;
    rows[front][behind] += 1;
  }
  for (std::size_t p = 0; p < pieces; ++p) {
    for (const auto& [other, sides] : rows[p]) {
      graph.neighbours.push_back(other);
      graph.edge_weights.push_back(sides);
    }
    graph.offsets.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
    graph.node_weights.push_back(static_cast<double>(mesh.counts[p].elements));
    graph.positions[p] = graph.positions[p] / std::max(points[p], 1.0);
  }
  return graph;
}

/// What is counted of pieces given to ranks.
struct redistribution_counts {
  int ranks = 0;                       ///< how many there are
  local_id pieces = 0;                 ///< how many there are
  double largest_rank = 0;             ///< its elements
  double smallest_rank = 0;            ///< its elements
  double imbalance = 0;                ///< largest over average
  double sides_between_ranks = 0;      ///< of elements
  std::size_t most_neighbours = 0;     ///< that a rank shares a side with
  std::int64_t disconnected_ranks = 0; ///< whose pieces are not connected by sides

  using fields =
      field_list<&redistribution_counts::ranks, &redistribution_counts::pieces,
                 &redistribution_counts::largest_rank, &redistribution_counts::smallest_rank,
                 &redistribution_counts::imbalance, &redistribution_counts::sides_between_ranks,
                 &redistribution_counts::most_neighbours, &redistribution_counts::disconnected_ranks>;
};

/// `redistribution_counts` of pieces given to ranks.
inline report describe_redistribution(const csr_graph& pieces, const std::vector<local_id>& rank, int ranks) {
  report summary;
  summary.name = "redistribution";
  const auto weights = part_weights(pieces, rank, ranks);
  std::vector<std::set<local_id>> neighbours(static_cast<std::size_t>(ranks));
  for (local_id p = 0; p < pieces.node_count(); ++p)
    for (const local_id other : pieces.row(p))
      if (const auto q = rank[p]; q != rank[other])
        neighbours[q].insert(rank[other]);
  std::size_t most = 0;
  for (const auto& of_rank : neighbours)
    most = std::max(most, of_rank.size());
  const labelled_components components = components_within(pieces, rank);
  std::vector<std::set<local_id>> of_rank(static_cast<std::size_t>(ranks));
  for (std::size_t p = 0; p < rank.size(); ++p)
    of_rank[rank[p]].insert(components.of_node[p]);
  summary.set(redistribution_counts{
      .ranks = ranks,
      .pieces = pieces.node_count(),
      .largest_rank = *std::max_element(weights.begin(), weights.end()),
      .smallest_rank = *std::min_element(weights.begin(), weights.end()),
      .imbalance = imbalance_of(pieces, rank, ranks),
      .sides_between_ranks = edge_cut(pieces, rank),
      .most_neighbours = most,
      .disconnected_ranks =
          std::count_if(of_rank.begin(), of_rank.end(), [](const auto& parts) { return parts.size() > 1; })});
  return summary;
}

/// Throws `partition_error` unless each of the ranks can have a piece.
/// Constant time.
/// \param pieces how many there are
/// \param ranks how many there are
inline void require_pieces_for(std::size_t pieces, int ranks) {
  if (ranks < 1 || static_cast<std::size_t>(ranks) > pieces)
    throw partition_error("cannot give " + std::to_string(pieces) + " subdomains to " +
                          std::to_string(ranks) +
                          " ranks; ask for at least one rank, and for as many subdomains as ranks");
}

} // namespace dovetail
