// near miss 1: it has no name
// error 1: f\.name\(\).*invalid|no member named 'name'
// near miss 2: a rank has one file
// error 2: f\.files_of_rank\(q\).*return-type|(constraint|because) 'std::same_as<std::.*string|type constraint.*string
// near miss 3: it writes the mesh of a rank without what all have
// error 3: f\.write\(source, mesh, paths\).*invalid|no matching member function for call to 'write'|too many arguments to function call
#include "dovetail/solver/concepts.hpp"

using names = std::vector<std::string>;
using paths = std::vector<std::filesystem::path>;
using source = dovetail::io::rank_source<3>;

struct my_format {
#if NEAR_MISS != 1
  std::string name() const;
#endif
#if NEAR_MISS == 2
  std::string files_of_rank(dovetail::local_id) const;
#else
  names files_of_rank(dovetail::local_id) const;
#endif
  names files_of_all() const;
#if NEAR_MISS == 3
  void write(const dovetail::rank_mesh<3>&, const paths&) const;
#else
  void write(const source&, const dovetail::rank_mesh<3>&, const paths&) const;
#endif
  void write_all(const source&, const paths&) const;
};

template <dovetail::rank_format F>
void use(const F&) {}

void call() {
  use(my_format{});
}
