/// One policy alone: METIS on a graph of one's own, and the native partitioner in its place.
#include "dovetail/adapters/metis.hpp"

#include <algorithm>
#include <cstdio>

namespace {

/// A chessboard of n x n nodes, each joined to its neighbours on the left, right, top and bottom.
dovetail::csr_graph chessboard(dovetail::local_id n) {
  dovetail::csr_graph graph;
  for (dovetail::local_id y = 0; y < n; ++y)
    for (dovetail::local_id x = 0; x < n; ++x) {
      const auto join = [&](dovetail::local_id nx, dovetail::local_id ny) {
        if (nx >= 0 && nx < n && ny >= 0 && ny < n)
          graph.neighbours.push_back(ny * n + nx);
      };
      join(x - 1, y);
      join(x + 1, y);
      join(x, y - 1);
      join(x, y + 1);
      graph.offsets.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
      graph.node_weights.push_back(1);
    }
  graph.edge_weights.assign(graph.neighbours.size(), 1);
  return graph;
}

double cut_weight(const dovetail::csr_graph& graph, const std::vector<dovetail::local_id>& parts) {
  double cut = 0;
  for (dovetail::local_id node = 0; node < graph.node_count(); ++node)
    for (const auto neighbour : graph.row(node))
      if (node < neighbour && parts[node] != parts[neighbour])
        cut += 1;
  return cut;
}

} // namespace

int main() {
  const auto graph = chessboard(64);

  // part partition
  const auto by_metis = dovetail::partition::metis{.imbalance = 1.03}(graph, 16);
  const auto by_greedy = dovetail::partition::greedy{.imbalance = 1.03}(graph, 16);
  // end

  // Squares of 16 x 16 nodes cut 2 x 3 x 64 edges.
  std::printf("edges cut: %g by METIS, %g by the native partitioner, %d by squares\n",
              cut_weight(graph, by_metis), cut_weight(graph, by_greedy), 2 * 3 * 64);
  return cut_weight(graph, by_metis) < 2 * 384 && cut_weight(graph, by_greedy) < 2 * 384 ? 0 : 1;
}
