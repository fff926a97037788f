// error: M::traits.*keeps_boundary.*(evaluated to 'false'|false)
#include "dovetail/mesher/concepts.hpp"

struct my_mesher {
#ifdef CORRECT
  static constexpr dovetail::mesher_traits traits{.keeps_boundary = true};
#else
  static constexpr dovetail::mesher_traits traits{.keeps_boundary = false};
#endif
  dovetail::mesher_result<3> operator()(const dovetail::mesher_input<3>&, const dovetail::any_sizing&) const;
};

template <dovetail::boundary_keeping_mesher<3> M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
