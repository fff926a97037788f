// near miss 1: it does not say which files it has
// error 1: f\.files_of_all\(\).*invalid|no member named 'files_of_all'
// near miss 2: it lays the files out without knowing how much the ranks have
// error 2: f\.lay_out\(source, counts, paths\).*invalid|no matching member function for call to 'lay_out'|too many arguments to function call
// near miss 3: it writes all ranks at once
// error 3: f\.write\(source, mesh, paths\).*invalid|no matching member function for call to 'write'|too many arguments to function call
#include "dovetail/solver/concepts.hpp"

using paths = std::vector<std::filesystem::path>;
using source = dovetail::io::rank_source<3>;

struct my_format {
  std::string name() const;
#if NEAR_MISS != 1
  std::vector<std::string> files_of_all() const;
#endif
#if NEAR_MISS == 2
  void lay_out(const source&, const paths&) const;
#else
  void lay_out(const source&, const std::vector<dovetail::io::rank_counts>&, const paths&) const;
#endif
#if NEAR_MISS == 3
  void write(const source&, const paths&) const;
#else
  void write(const source&, const dovetail::rank_mesh<3>&, const paths&) const;
#endif
};

template <dovetail::shared_rank_format F>
void use(const F&) {}

void call() {
  use(my_format{});
}
