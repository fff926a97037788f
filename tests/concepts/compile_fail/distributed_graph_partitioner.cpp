// near miss 1: it wants the whole graph
// error 1: p\(network, g, parts\).*invalid|no matching function for call to object of type 'const my_partitioner
// near miss 2: it does not say whether another number of ranks gives other parts
// error 2: p\.depends_on_ranks\(\).*invalid|no member named 'depends_on_ranks'
// near miss 3: its call is not const
// error 3: p\(network, g, parts\).*invalid|no matching function for call to object of type 'const my_partitioner
#include "dovetail/partition/distributed_concepts.hpp"

struct my_partitioner {
  using parts = std::vector<dovetail::local_id>;
#if NEAR_MISS == 1
  parts operator()(dovetail::any_communicator&, const dovetail::csr_graph&, int) const;
#elif NEAR_MISS == 3
  parts operator()(dovetail::any_communicator&, const dovetail::distributed_csr_graph&, int);
#else
  parts operator()(dovetail::any_communicator&, const dovetail::distributed_csr_graph&, int) const;
#endif
#if NEAR_MISS != 2
  bool depends_on_ranks() const;
#endif
};

template <dovetail::distributed_graph_partitioner P>
void use(const P&) {}

void call() {
  use(my_partitioner{});
}
