// near miss 1: it is not told how many parts
// first error 1: with_partitioner takes an? graph_partitioner
// near miss 2: it gives no parts
// first error 2: with_partitioner takes an? graph_partitioner
// near miss 3: the call operator is not const
// first error 3: with_partitioner takes an? graph_partitioner
#include "dovetail/partition/concepts.hpp"
#include "dovetail/pipeline/parameters.hpp"

struct my_policy {
#if NEAR_MISS == 1
  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph&) const;
#elif NEAR_MISS == 2
  void operator()(const dovetail::csr_graph&, int) const;
#elif NEAR_MISS == 3
  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph&, int);
#else
  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph&, int) const;
#endif
};

void call() {
  dovetail::parameters<>{}.with_partitioner(my_policy{});
}
