// near miss 1: the type has not opted in by enable_graph
// error 1: enable_graph
// near miss 2: the type of its iterator is not named
// error 2: adjacency_iterator
// near miss 3: it cannot list the neighbours of a vertex
// error 3: adjacent_vertices\(v, g\).*invalid|adjacent_vertices
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
#if NEAR_MISS != 2
  using adjacency_iterator = const int*;
#endif
};

#if NEAR_MISS != 1
template <>
inline constexpr bool dovetail::enable_graph<my_graph> = true;
#endif
#if NEAR_MISS != 3
std::pair<const int*, const int*> adjacent_vertices(int, const my_graph&);
#endif

template <dovetail::adjacency_graph G>
void use(const G&) {}

void call() {
  use(my_graph{});
}
