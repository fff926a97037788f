// near miss 1: the call operator is not const
// error 1: i\(mesh, frozen, h\).*invalid|no matching function for call to object of type 'const my_improver
// near miss 2: it is not told what is frozen
// error 2: i\(mesh, frozen, h\).*invalid|no matching function for call to object of type 'const my_improver
// near miss 3: it returns a mesh instead of changing the one given
// error 3: i\(mesh, frozen, h\).*return-type|(constraint|because) 'std::same_as<(dovetail::simplicial_mesh<3>|mesh)
// near miss 4: it has no traits
// error 4: I::traits|no member named 'traits'
#include "dovetail/improver/concepts.hpp"

using mesh = dovetail::simplicial_mesh<3>;
using frozen = dovetail::frozen_entities<3>;

struct my_improver {
#if NEAR_MISS != 4
  static constexpr dovetail::improver_traits traits{};
#endif
#if NEAR_MISS == 1
  dovetail::report operator()(mesh&, const frozen&, const dovetail::any_sizing&);
#elif NEAR_MISS == 2
  dovetail::report operator()(mesh&, const dovetail::any_sizing&) const;
#elif NEAR_MISS == 3
  mesh operator()(const mesh&, const frozen&, const dovetail::any_sizing&) const;
#else
  dovetail::report operator()(mesh&, const frozen&, const dovetail::any_sizing&) const;
#endif
};

template <dovetail::improver<3> I>
void use(const I&) {}

void call() {
  use(my_improver{});
}
