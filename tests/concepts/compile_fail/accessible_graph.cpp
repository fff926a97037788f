// near miss 1: nothing says how to read it
// error 1: graph_access<
// near miss 2: it does not say how many edges a row may have
// error 2: row_slots
// near miss 3: it has no list of all edges
// error 3: edge_slots|list_edge
// near miss 4: it does not say whether edges may be parallel
// error 4: edge_parallel_category
#include "dovetail/graph/boost_adaptor.hpp"

struct my_graph {};

#if NEAR_MISS != 1
template <>
struct dovetail::graph_access<my_graph> {
#if NEAR_MISS != 4
  using edge_parallel_category = boost::disallow_parallel_edge_tag;
#endif
  static std::size_t vertex_count(const my_graph&);
#if NEAR_MISS != 2
  static std::size_t row_slots(const my_graph&, dovetail::local_id v);
#endif
  static bool row_edge(const my_graph&, dovetail::local_id v, std::size_t slot, dovetail::graph_edge& e);
#if NEAR_MISS != 3
  static std::size_t edge_slots(const my_graph&);
  static bool list_edge(const my_graph&, std::size_t slot, dovetail::graph_edge& e);
#endif
};
#endif

template <dovetail::accessible_graph G>
void use(const G&) {}

void call() {
  use(my_graph{});
}
