// near miss 1: it does not say
// error 1: M::elements_per_inverse_cubed_size
// near miss 2: it says so by a function
// error 2: M::elements_per_inverse_cubed_size
// near miss 3: each mesher has a number of its own
// error 3: M::elements_per_inverse_cubed_size
#include "dovetail/mesher/preferences.hpp"

struct my_mesher {
#if NEAR_MISS == 2
  static double elements_per_inverse_cubed_size();
#elif NEAR_MISS == 3
  double elements_per_inverse_cubed_size = 12;
#elif NEAR_MISS == 0
  static constexpr double elements_per_inverse_cubed_size = 12;
#endif
};

template <dovetail::calibrated_mesher M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
