// near miss 1: the type has not opted in by enable_graph
// error 1: enable_graph
// near miss 2: it gives the neighbours of a vertex but not its edges
// error 2: out_edge_iterator
// near miss 3: edges have no ends
// error 3: source\(e, g\).*invalid
#include "dovetail/graph/concepts.hpp"

#include <cstddef>

struct my_graph {};

struct my_edge {
  int from = 0, to = 0;
  bool operator==(const my_edge&) const = default;
};

template <>
struct boost::graph_traits<my_graph> {
  using vertex_descriptor = int;
  using edge_descriptor = my_edge;
  using directed_category = boost::undirected_tag;
  using edge_parallel_category = boost::disallow_parallel_edge_tag;
  using traversal_category = boost::incidence_graph_tag;
  using degree_size_type = std::size_t;
#if NEAR_MISS != 2
  using out_edge_iterator = const my_edge*;
#endif
};

#if NEAR_MISS != 1
template <>
inline constexpr bool dovetail::enable_graph<my_graph> = true;
#endif

#if NEAR_MISS != 3
int source(my_edge, const my_graph&);
int target(my_edge, const my_graph&);
#endif
#if NEAR_MISS == 2
std::pair<const int*, const int*> adjacent_vertices(int, const my_graph&);
#else
std::pair<const my_edge*, const my_edge*> out_edges(int, const my_graph&);
std::size_t out_degree(int, const my_graph&);
#endif

template <dovetail::incidence_graph G>
void use(const G&) {}

void call() {
  use(my_graph{});
}
