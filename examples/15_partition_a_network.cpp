/// A network of Boost.Graph, partitioned as it is, and again with its main streets in one piece each.
#include "dovetail/adapters/boost_graph.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/part_weights.hpp"
#include "dovetail/simplification/simplify.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <vector>

namespace {

using namespace dovetail;

struct street {
  double lanes = 1;
};
using city = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property, street>;

/// Streets between n x n crossings; every eighth one from west to east has four lanes.
city make_city(std::size_t n) {
  city streets(n * n);
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x) {
      if (x + 1 < n)
        boost::add_edge(y * n + x, y * n + x + 1, street{y % 8 == 4 ? 4.0 : 1.0}, streets);
      if (y + 1 < n)
        boost::add_edge(y * n + x, (y + 1) * n + x, street{1}, streets);
    }
  return streets;
}

// part rule
/// Streets of more than two lanes are not cut.
struct whole_main_streets {
  template <weighted_graph G>
  side_judgement operator()(const G&, const graph_dual& streets) const {
    side_judgement judged{.wanted_quality = 0.5};
    for (std::size_t s = 0; s < streets.side_count(); ++s)
      judged.quality.push_back(1 / streets.side_weight(static_cast<local_id>(s)));
    return judged;
  }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const { return a.side < b.side; }
  double penalty(const deficit&) const { return 100; } // of those that the bound keeps
};
// end

int main_streets_cut(const city& streets, const std::vector<local_id>& part) {
  int cut = 0;
  for (auto [s, end] = edges(streets); s != end; ++s)
    if (streets[*s].lanes > 2 && part[source(*s, streets)] != part[target(*s, streets)])
      ++cut;
  return cut;
}

} // namespace

int main() {
  // part partition
  const city streets = make_city(64);                              // a boost::adjacency_list
  const boost_view network(streets, get(&street::lanes, streets)); // an edge weighs its lanes

  const std::vector<local_id> part = partition::greedy{}(network, 8);
  // end
  // part simplify
  const graph_dual duals(network); // its nodes as elements, its edges as sides
  const auto simplified = simplify(network, duals, whole_main_streets{}, {.subdomains = 8, .fraction = 0.2});

  const std::vector<local_id> part_of_super = partition::greedy{}(simplified.graph, 8);
  std::vector<local_id> whole;
  for (const local_id super : simplified.super_of_element)
    whole.push_back(part_of_super[super]);
  // end
  std::printf("as it is:         %3.0f lanes cut, main streets cut in %d places, imbalance %.2f\n",
              edge_cut(network, part), main_streets_cut(streets, part), imbalance_of(network, part, 8));
  std::printf("with the rule:    %3.0f lanes cut, main streets cut in %d places, imbalance %.2f\n",
              edge_cut(network, whole), main_streets_cut(streets, whole), imbalance_of(network, whole, 8));
  return main_streets_cut(streets, whole) == 0 ? 0 : 1;
}
