/// A partitioner of one's own, used by the whole pipeline.
/// Usage: c01_custom_partitioner FILE [SUBDOMAINS (default 8)]
#include "dovetail/graph/breadth_first.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cstdio>
#include <cstdlib>
#include <numeric>

/// Layers of equal weight around the first node of each component of the graph. A policy is a plain struct:
/// its members are its parameters, its call operator does the job.
struct layers {
  dovetail::local_id first_node = 0;

  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph& graph, int parts) const {
    const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
    std::vector<dovetail::local_id> part_of_node(graph.node_weights.size(), dovetail::no_id);
    dovetail::local_id part = 0, left = graph.node_count();
    double weight = 0;
    for (dovetail::local_id i = 0; i < graph.node_count(); ++i) {
      const auto start = (first_node + i) % graph.node_count();
      if (part_of_node[start] != dovetail::no_id)
        continue;
      for (const auto node : dovetail::breadth_first_order(graph, start)) {
        part_of_node[node] = part;
        weight += graph.node_weights[node];
        const bool full = weight >= total * (part + 1) / parts;
        const bool few_left = --left <= parts - 1 - part; // just enough to leave no part empty
        if (part + 1 < parts && (full || few_left))
          ++part;
      }
    }
    return part_of_node;
  }
};
static_assert(dovetail::graph_partitioner<layers>);

int main(int argc, char** argv) try {
  using namespace dovetail;
  const auto model = read_occt_model(argc > 1 ? argv[1] : "").model;
  generate_options options;
  options.subdomains = argc > 2 ? std::atoi(argv[2]) : 8;
  const auto given = parameters<>{}.with_partitioner(layers{.first_node = 0}).with_options(options);
  const auto result = generate<3>(model, uniform_size(model.bounds().diagonal() / 25), given);
  for (std::size_t s = 0; s < result.mesh.counts.size(); ++s)
    std::printf("subdomain %zu: %lld tetrahedra\n", s,
                static_cast<long long>(result.mesh.counts[s].elements));
  return result.failures.empty() ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
