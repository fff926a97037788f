// near miss 1: the parts are not local_id
// error 1: p\(g, parts\).*return-type|(constraint|because) 'std::same_as<std::vector<short>
// near miss 2: the call operator is not const
// error 2: p\(g, parts\).*(is invalid|invalid:)|no matching function for call to .*const my_partitioner
// near miss 3: it cannot be copied
// error 3: (copy_constructible|is_constructible)
#include "dovetail/partition/concepts.hpp"

#include <memory>

struct my_partitioner {
#if NEAR_MISS == 1
  std::vector<short> operator()(const dovetail::csr_graph&, int) const;
#elif NEAR_MISS == 2
  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph&, int);
#else
  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph&, int) const;
#endif
#if NEAR_MISS == 3
  std::unique_ptr<int> random_state;
#endif
};

template <dovetail::graph_partitioner P>
void use(const P&) {}

void call() {
  use(my_partitioner{});
}
