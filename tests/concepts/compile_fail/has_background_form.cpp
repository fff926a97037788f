// near miss 1: it says only whether it has one
// error 1: m\.for_background\(\).*return-type|(constraint|because) 'std::same_as<(bool|_Bool)
// near miss 2: it is a mesher of another type
// error 2: m\.for_background\(\).*return-type|(constraint|because) 'std::same_as<other_mesher
// near miss 3: asking for it changes the mesher
// error 3: m\.for_background\(\).*invalid|not marked const
#include "dovetail/mesher/preferences.hpp"

struct other_mesher {};

struct my_mesher {
#if NEAR_MISS == 1
  bool for_background() const;
#elif NEAR_MISS == 2
  other_mesher for_background() const;
#elif NEAR_MISS == 3
  my_mesher for_background();
#else
  my_mesher for_background() const;
#endif
};

template <dovetail::has_background_form M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
