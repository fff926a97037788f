// near miss 1: the type has not opted in by enable_graph
// error 1: enable_graph
// near miss 2: edges have no type
// error 2: edge_descriptor
// near miss 3: it does not say which walks it allows
// error 3: traversal_category
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
#if NEAR_MISS != 2
  using edge_descriptor = my_edge;
#endif
  using directed_category = boost::undirected_tag;
  using edge_parallel_category = boost::disallow_parallel_edge_tag;
#if NEAR_MISS != 3
  using traversal_category = boost::incidence_graph_tag;
#endif
};

#if NEAR_MISS != 1
template <>
inline constexpr bool dovetail::enable_graph<my_graph> = true;
#endif

template <dovetail::graph G>
void use(const G&) {}

void call() {
  use(my_graph{});
}
