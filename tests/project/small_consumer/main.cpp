// The least that a program has of the library: quick to compile in any way, with a function that is compiled
// or not.
#include "dovetail/partition/greedy.hpp"

#include <cstdio>

int main() {
  dovetail::csr_graph path; // 0 - 1 - 2 - 3
  for (dovetail::local_id node = 0; node < 4; ++node) {
    for (const dovetail::local_id other : {node - 1, node + 1})
      if (other >= 0 && other < 4)
        path.neighbours.push_back(other);
    path.offsets.push_back(static_cast<std::int64_t>(path.neighbours.size()));
    path.node_weights.push_back(1);
  }
  path.edge_weights.assign(path.neighbours.size(), 1);
  const auto parts = dovetail::partition::greedy{}(path, 2);
  std::printf("%d %d %d %d\n", parts[0], parts[1], parts[2], parts[3]);
  return parts[0] == parts[1] && parts[2] == parts[3] && parts[1] != parts[2] ? 0 : 1;
}
