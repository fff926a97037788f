// near miss 1: the type has not opted in by enable_graph
// error 1: enable_graph
// near miss 2: it cannot list its vertices
// error 2: vertices\(g\)
// near miss 3: it does not know how many vertices it has
// error 3: num_vertices\(g\)
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
  using vertex_iterator = const int*;
  using vertices_size_type = std::size_t;
};

#if NEAR_MISS != 1
template <>
inline constexpr bool dovetail::enable_graph<my_graph> = true;
#endif
#if NEAR_MISS != 2
std::pair<const int*, const int*> vertices(const my_graph&);
#endif
#if NEAR_MISS != 3
std::size_t num_vertices(const my_graph&);
#endif

template <dovetail::vertex_list_graph G>
void use(const G&) {}

void call() {
  use(my_graph{});
}
