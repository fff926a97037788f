// near miss 1: it does not say
// error 1: m\.elements_per_subdomain\(\).*invalid|no member named 'elements_per_subdomain'
// near miss 2: it is asked for more than it may be told
// error 2: m\.elements_per_subdomain\(\).*invalid|too few arguments
// near miss 3: the function is not const
// error 3: m\.elements_per_subdomain\(\).*invalid|not marked const
#include "dovetail/mesher/preferences.hpp"

struct my_mesher {
#if NEAR_MISS == 2
  double elements_per_subdomain(double size) const;
#elif NEAR_MISS == 3
  double elements_per_subdomain();
#elif NEAR_MISS == 0
  double elements_per_subdomain() const;
#endif
};

template <dovetail::piece_sizing_mesher M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
