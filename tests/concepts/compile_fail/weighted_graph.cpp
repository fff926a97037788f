// near miss 1: its nodes have no weights
// error 1: g\.node_weight\(v\)
// near miss 2: it visits the ends of edges without their weights
// error 2: g\.for_each_edge\(v, visit\)
// near miss 3: it is not known who is next to whom
// error 3: g\.for_each_neighbour\(v, visit\)
#include "dovetail/graph/concepts.hpp"

struct my_graph {
  int node_count() const;
#if NEAR_MISS != 3
  template <class Visit>
  void for_each_neighbour(dovetail::local_id v, const Visit& visit) const;
#endif
#if NEAR_MISS != 1
  double node_weight(dovetail::local_id v) const;
#endif
#if NEAR_MISS == 2
  void for_each_edge(dovetail::local_id v, void (&visit)(dovetail::local_id)) const;
#else
  template <class Visit>
  void for_each_edge(dovetail::local_id v, const Visit& visit) const;
#endif
};

template <dovetail::weighted_graph G>
void use(const G&) {}

void call() {
  use(my_graph{});
}
