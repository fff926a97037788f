// near miss 1: it writes whole meshes, which would have to be in memory at once
// error 1: w\(mesh, folder\).*invalid|no matching function for call to object of type 'const my_writer
// near miss 2: it gives no report
// error 2: w\(mesh, folder\).*return-type|(constraint|because) 'std::same_as<void
// near miss 3: the call operator is not const
// error 3: w\(mesh, folder\).*invalid|no matching function for call to object of type 'const my_writer
#include "dovetail/files/concepts.hpp"

using folder = std::filesystem::path;

struct my_writer {
#if NEAR_MISS == 1
  dovetail::report operator()(const dovetail::simplicial_mesh<3>&, const folder&) const;
#elif NEAR_MISS == 2
  void operator()(const dovetail::distributed_mesh&, const folder&) const;
#elif NEAR_MISS == 3
  dovetail::report operator()(const dovetail::distributed_mesh&, const folder&);
#else
  dovetail::report operator()(const dovetail::distributed_mesh&, const folder&) const;
#endif
};

template <dovetail::mesh_writer W>
void use(const W&) {}

void call() {
  use(my_writer{});
}
