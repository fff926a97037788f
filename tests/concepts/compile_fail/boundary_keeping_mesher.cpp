// near miss 1: it does not keep the boundary it is given
// error 1: traits(\)|)\.(dovetail::mesher_traits::|)keeps_boundary.*(evaluated to .?false)
// near miss 2: it does not say whether it keeps the boundary
// error 2: traits(\)|)\.(dovetail::mesher_traits::|)keeps_boundary.*(evaluated to .?false)
// near miss 3: its traits are known at run time only
// error 3: (not usable in a constant expression|non-constant|constant expression|M::traits)
#include "dovetail/mesher/concepts.hpp"

struct my_mesher {
#if NEAR_MISS == 1
  static constexpr dovetail::mesher_traits traits{.keeps_boundary = false};
#elif NEAR_MISS == 2
  static constexpr dovetail::mesher_traits traits{};
#elif NEAR_MISS == 3
  static dovetail::mesher_traits traits;
#else
  static constexpr dovetail::mesher_traits traits{.keeps_boundary = true};
#endif
  dovetail::mesher_result<3> operator()(const dovetail::mesher_input<3>&, const dovetail::any_sizing&) const;
};

template <dovetail::boundary_keeping_mesher<3> M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
