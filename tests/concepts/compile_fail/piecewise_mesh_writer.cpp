// near miss 1: it begins files, but does not write a mesh by itself
// error 1: w\(mesh, folder\).*invalid|no matching function for call to object of type 'const my_writer|'const my_writer' does not provide a call operator
// near miss 2: it writes its files at once
// error 2: w\.begin\(mesh, unfinished\).*return-type|(constraint|because) 'std::same_as<void|type constraint.*void
// near miss 3: begin is not const
// error 3: w\.begin\(mesh, unfinished\).*invalid|'this' argument to member function 'begin' has type 'const my_writer
#include "dovetail/files/concepts.hpp"

using folder = std::filesystem::path;
using output = dovetail::io::piecewise_output<3>;

struct my_writer {
#if NEAR_MISS != 1
  dovetail::report operator()(const dovetail::distributed_mesh&, const folder&) const;
#endif
#if NEAR_MISS == 2
  void begin(const dovetail::distributed_mesh&, const folder&) const;
#elif NEAR_MISS == 3
  output begin(const dovetail::distributed_mesh&, const folder&);
#else
  output begin(const dovetail::distributed_mesh&, const folder&) const;
#endif
};

template <dovetail::piecewise_mesh_writer W>
void use(const W&) {}

void call() {
  use(my_writer{});
}
