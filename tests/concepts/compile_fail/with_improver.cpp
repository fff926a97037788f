// near miss 1: it returns no report
// first error 1: with_improver takes an improver
// error 1: i\(mesh, frozen, h\).*return-type|std::same_as<void, (dovetail::)?report>
// near miss 2: it is not told what is frozen
// first error 2: with_improver takes an improver
// error 2: i\(mesh, frozen, h\).*invalid
// near miss 3: the call operator is not const
// first error 3: with_improver takes an improver
// error 3: i\(mesh, frozen, h\).*invalid
#include "dovetail/pipeline/parameters.hpp"

using mesh = dovetail::simplicial_mesh<3>;
using frozen = dovetail::frozen_entities<3>;
using size = dovetail::any_sizing;

struct my_improver {
  static constexpr dovetail::improver_traits traits{};
#if NEAR_MISS == 1
  void operator()(mesh&, const frozen&, const size&) const;
#elif NEAR_MISS == 2
  dovetail::report operator()(mesh&, const size&) const;
#elif NEAR_MISS == 3
  dovetail::report operator()(mesh&, const frozen&, const size&);
#else
  dovetail::report operator()(mesh&, const frozen&, const size&) const;
#endif
};

void call() {
  dovetail::parameters<>{}.with_improver(my_improver{});
}
