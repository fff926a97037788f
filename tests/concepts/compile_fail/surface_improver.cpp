// near miss 1: it is an improver of triangles that is not told their surface
// error 1: i\(mesh, frozen, h, host\).*invalid|no matching function for call to object of type 'const my_improver
// near miss 2: it wants to change the surface
// error 2: i\(mesh, frozen, h, host\).*invalid|no matching function for call to object of type 'const my_improver
// near miss 3: it cannot do without a surface
// error 3: i\(mesh, frozen, h\).*invalid|no matching function for call to object of type 'const my_improver
// near miss 4: it improves tetrahedra
// error 4: i\(mesh, frozen, h\).*invalid|no matching function for call to object of type 'const my_improver
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/surface_host.hpp"

#if NEAR_MISS == 4
constexpr int dimension = 3;
#else
constexpr int dimension = 2;
#endif
using mesh = dovetail::simplicial_mesh<dimension>;
using frozen = dovetail::frozen_entities<dimension>;
using size = dovetail::any_sizing;

struct my_improver {
  static constexpr dovetail::improver_traits traits{};
#if NEAR_MISS != 3
  dovetail::report operator()(mesh&, const frozen&, const size&) const;
#endif
#if NEAR_MISS == 2
  dovetail::report operator()(mesh&, const frozen&, const size&, dovetail::surface_host&) const;
#elif NEAR_MISS != 1
  dovetail::report operator()(mesh&, const frozen&, const size&, const dovetail::surface_host&) const;
#endif
};

template <dovetail::surface_improver I>
void use(const I&) {}

void call() {
  use(my_improver{});
}
