// near miss 1: it gives the ranks alone
// error 1: r\(mesh, ranks\).*return-type|(constraint|because) 'std::same_as<std::vector<(int|dovetail::local_id)|type constraint.*vector<
// near miss 2: it does not take the number of ranks
// error 2: r\(mesh, ranks\).*invalid|no matching function for call to object of type 'const my_redistributor
// near miss 3: its call is not const
// error 3: r\(mesh, ranks\).*invalid|no matching function for call to object of type 'const my_redistributor
#include "dovetail/distributed/concepts.hpp"

struct my_redistributor {
#if NEAR_MISS == 1
  std::vector<dovetail::local_id> operator()(const dovetail::distributed_mesh&, int) const;
#elif NEAR_MISS == 2
  dovetail::redistribution<3> operator()(const dovetail::distributed_mesh&) const;
#elif NEAR_MISS == 3
  dovetail::redistribution<3> operator()(const dovetail::distributed_mesh&, int);
#else
  dovetail::redistribution<3> operator()(const dovetail::distributed_mesh&, int) const;
#endif
};

template <dovetail::redistributor R>
void use(const R&) {}

void call() {
  use(my_redistributor{});
}
