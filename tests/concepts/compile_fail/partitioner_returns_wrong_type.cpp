// error: p\(g, parts\).*(does not satisfy|invalid)|std::vector<short.*does not satisfy
#include "dovetail/partition/concepts.hpp"

struct my_partitioner {
#ifdef CORRECT
  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph&, int) const;
#else
  std::vector<short> operator()(const dovetail::csr_graph&, int) const;
#endif
};

void use(dovetail::graph_partitioner auto) {}

void call() {
  use(my_partitioner{});
}
