// near miss 1: it says only whether it has fallbacks
// error 1: m\.fallbacks\(\).*return-type|(constraint|because) 'std::same_as<(bool|_Bool)
// near miss 2: its fallbacks are meshers of another type
// error 2: m\.fallbacks\(\).*return-type|(constraint|because) 'std::same_as<std::vector<other_mesher
// near miss 3: asking for the fallbacks changes it
// error 3: m\.fallbacks\(\).*invalid|not marked const
#include "dovetail/mesher/fallbacks.hpp"

struct other_mesher {};

struct my_mesher {
#if NEAR_MISS == 1
  bool fallbacks() const;
#elif NEAR_MISS == 2
  std::vector<other_mesher> fallbacks() const;
#elif NEAR_MISS == 3
  std::vector<my_mesher> fallbacks();
#else
  std::vector<my_mesher> fallbacks() const;
#endif
};

template <dovetail::has_fallbacks M>
void use(const M&) {}

void call() {
  use(my_mesher{});
}
