// near miss 1: it does not say how many nodes it has
// error 1: g\.node_count\(\)
// near miss 2: it returns the neighbours of a node where it should visit them
// error 2: g\.for_each_neighbour\(v, visit\)
// near miss 3: its walk changes it
// error 3: g\.for_each_neighbour\(v, visit\)
#include "dovetail/graph/concepts.hpp"

#include <vector>

struct my_graph {
#if NEAR_MISS != 1
  int node_count() const;
#endif
#if NEAR_MISS == 2
  std::vector<dovetail::local_id> for_each_neighbour(dovetail::local_id v) const;
#elif NEAR_MISS == 3
  template <class Visit>
  void for_each_neighbour(dovetail::local_id v, const Visit& visit);
#else
  template <class Visit>
  void for_each_neighbour(dovetail::local_id v, const Visit& visit) const;
#endif
};

template <dovetail::graph G>
void use(const G&) {}

void call() {
  use(my_graph{});
}
