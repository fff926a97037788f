// error: w\(mesh, folder\).*invalid
#include "dovetail/io/concepts.hpp"

struct my_writer {
#ifdef CORRECT
  dovetail::report operator()(const dovetail::distributed_mesh&, const std::filesystem::path&) const;
#else
  dovetail::report operator()(const dovetail::simplicial_mesh<3>&, const std::filesystem::path&) const;
#endif
};

template <dovetail::mesh_writer W>
void use(const W&) {}

void call() {
  use(my_writer{});
}
