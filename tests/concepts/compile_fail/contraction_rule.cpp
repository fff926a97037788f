// near miss 1: it names the side that goes by its number where it should answer for the first
// error 1: r\.first_goes\(a, b\).*return-type|constraint 'std::same_as<int, (bool|_Bool)>
// near miss 2: a refused side has no price
// error 2: r\.price\(s\)
// near miss 3: its choice changes it
// error 3: r\.first_goes\(a, b\)
#include "dovetail/simplification/concepts.hpp"

using dovetail::wedge_side;

struct my_rule {
#if NEAR_MISS == 1
  dovetail::local_id first_goes(const wedge_side& a, const wedge_side& b) const;
#elif NEAR_MISS == 3
  bool first_goes(const wedge_side& a, const wedge_side& b);
#else
  bool first_goes(const wedge_side& a, const wedge_side& b) const;
#endif
#if NEAR_MISS != 2
  double price(const dovetail::shortfall& missed) const;
#endif
};

template <dovetail::contraction_rule R>
void use(const R&) {}

void call() {
  use(my_rule{});
}
