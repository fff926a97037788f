// near miss 1: it returns no report
// first error 1: with_background_improver takes an improver of tetrahedra
// near miss 2: it improves triangles alone
// first error 2: with_background_improver takes an improver of tetrahedra
// near miss 3: it has no traits
// first error 3: with_background_improver takes an improver of tetrahedra
#include "dovetail/pipeline/parameters.hpp"

#include <type_traits>

constexpr int dimension = NEAR_MISS == 2 ? 2 : 3;

struct my_improver {
#if NEAR_MISS != 3
  static constexpr dovetail::improver_traits traits{};
#endif
  std::conditional_t<NEAR_MISS == 1, void, dovetail::report>
  operator()(dovetail::simplicial_mesh<dimension>&, const dovetail::frozen_entities<dimension>&,
             const dovetail::any_sizing&) const;
};

void call() {
  dovetail::parameters<>{}.with_background_improver(my_improver{});
}
