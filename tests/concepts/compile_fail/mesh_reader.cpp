// near miss 1: it returns a bare mesh, without arrays and names
// error 1: r\(file\).*return-type|(constraint|because) 'std::same_as<dovetail::simplicial_mesh<3>
// near miss 2: it fills an argument
// error 2: r\(file\).*invalid|no matching function for call to object of type 'const my_reader
// near miss 3: it reads a stream, so that its errors cannot name the file
// error 3: r\(file\).*invalid|no matching function for call to object of type 'const my_reader
#include "dovetail/files/concepts.hpp"

#include <istream>

using file = std::filesystem::path;

struct my_reader {
#if NEAR_MISS == 1
  dovetail::simplicial_mesh<3> operator()(const file&) const;
#elif NEAR_MISS == 2
  void operator()(const file&, dovetail::io::loaded_mesh&) const;
#elif NEAR_MISS == 3
  dovetail::io::loaded_mesh operator()(std::istream&) const;
#else
  dovetail::io::loaded_mesh operator()(const file&) const;
#endif
};

template <dovetail::mesh_reader R>
void use(const R&) {}

void call() {
  use(my_reader{});
}
