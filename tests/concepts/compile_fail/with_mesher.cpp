// near miss 1: a mesher of whole domains: it does not keep the boundary it is given
// first error 1: with_mesher takes a boundary_keeping_mesher
// error 1: traits(\)|)\.(dovetail::mesher_traits::|)keeps_boundary.*(evaluated to .?false)
// near miss 2: it takes no sizing field
// first error 2: with_mesher takes a boundary_keeping_mesher
// error 2: m\(in, h\).*invalid
// near miss 3: it declares no traits
// first error 3: with_mesher takes a boundary_keeping_mesher
// error 3: M::traits.*invalid
#include "dovetail/pipeline/parameters.hpp"

struct my_mesher {
#if NEAR_MISS != 3
  static constexpr dovetail::mesher_traits traits{.keeps_boundary = NEAR_MISS != 1};
#endif
#if NEAR_MISS == 2
  dovetail::mesher_result<3> operator()(const dovetail::mesher_input<3>&) const;
#else
  dovetail::mesher_result<3> operator()(const dovetail::mesher_input<3>&, const dovetail::any_sizing&) const;
#endif
};

void call() {
  dovetail::parameters<>{}.with_mesher(my_mesher{});
}
