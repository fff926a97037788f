/// A partitioner of one's own, used by the whole pipeline.
/// Usage: 02_own_partitioner FILE [SUBDOMAINS (default 8)]
#include "dovetail/geometry/occt_model.hpp"
#include "dovetail/graph/csr_boost.hpp"
#include "dovetail/graph/traversal.hpp"
#include "dovetail/mesher/tetgen.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cstdio>
#include <cstdlib>
#include <numeric>

/// Cuts the breadth-first order of the graph into runs of equal weight: layers around the first node.
/// A policy is a plain struct: its members are its parameters, its call operator does the job.
struct layers {
  dovetail::local_id first_node = 0;

  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph& graph, int parts) const {
    const auto order = all_nodes_from(graph);
    const double total = std::accumulate(graph.node_weights.begin(), graph.node_weights.end(), 0.0);
    std::vector<dovetail::local_id> part_of_node(order.size());
    dovetail::local_id part = 0;
    double weight = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto node = static_cast<std::size_t>(order[k]);
      part_of_node[node] = part;
      weight += graph.node_weights[node];
      // The next part begins when this one is full, or when the nodes left are just enough to fill none
      // empty.
      const bool full = weight >= total * (part + 1) / parts;
      const bool few_left = static_cast<int>(order.size() - k - 1) <= parts - 1 - part;
      if (part < parts - 1 && (full || few_left))
        ++part;
    }
    return part_of_node;
  }

private:
  /// The graph may have several components: each is entered at its first node.
  std::vector<dovetail::local_id> all_nodes_from(const dovetail::csr_graph& graph) const {
    std::vector<bool> seen(graph.node_weights.size(), false);
    std::vector<dovetail::local_id> order;
    for (dovetail::local_id i = 0; i < graph.node_count(); ++i)
      if (const auto start = (first_node + i) % graph.node_count(); !seen[static_cast<std::size_t>(start)])
        for (const auto node : dovetail::breadth_first_order(graph, start)) {
          seen[static_cast<std::size_t>(node)] = true;
          order.push_back(node);
        }
    return order;
  }
};

static_assert(dovetail::graph_partitioner<layers>);

int main(int argc, char** argv) try {
  using namespace dovetail;
  if (argc < 2) {
    std::puts("usage: 02_own_partitioner FILE [SUBDOMAINS]");
    return 2;
  }
  const auto model = read_occt_model(argv[1]).model;
  const uniform_size size(model.bounds().diagonal() / 25);
  generate_options options;
  options.subdomains = argc > 2 ? std::atoi(argv[2]) : 8;
  const auto result = generate<3>(model, size,
                                  parameters<>{}
                                      .with_mesher(mesher::tetgen{})
                                      .with_partitioner(layers{.first_node = 0})
                                      .with_options(options));
  for (std::size_t s = 0; s < result.mesh.counts.size(); ++s)
    std::printf("subdomain %zu: %lld tetrahedra\n", s,
                static_cast<long long>(result.mesh.counts[s].elements));
  return result.failures.empty() ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
