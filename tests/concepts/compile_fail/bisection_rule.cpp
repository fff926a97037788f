// near miss 1: it splits in equal halves only
// error 1: b\(g, left, right\).*invalid|no matching function for call to object of type 'const my_rule
// near miss 2: it returns a truth value per node
// error 2: b\(g, left, right\).*return-type|(constraint|because) 'std::same_as<std::vector<(bool|_Bool)>
// near miss 3: its call changes it
// error 3: b\(g, left, right\).*invalid|no matching function for call to object of type 'const my_rule
#include "dovetail/partition/recursive_bisection.hpp"

using halves = std::vector<dovetail::local_id>;

struct my_rule {
#if NEAR_MISS == 1
  halves operator()(const dovetail::csr_graph&) const;
#elif NEAR_MISS == 2
  std::vector<bool> operator()(const dovetail::csr_graph&, int, int) const;
#elif NEAR_MISS == 3
  halves operator()(const dovetail::csr_graph&, int, int);
#else
  halves operator()(const dovetail::csr_graph&, int, int) const;
#endif
};

template <dovetail::bisection_rule B>
void use(const B&) {}

void call() {
  use(my_rule{});
}
