// near miss 1: it knows no bound
// error 1: h\.smallest_size_in\(box\).*invalid|no member named 'smallest_size_in'
// near miss 2: it knows the bound at a point only
// error 2: h\.smallest_size_in\(box\).*invalid|no viable conversion
// near miss 3: it has bounds and no sizes
// error 3: h\(p\).*invalid|does not provide a call operator
// near miss 4: it returns a pair of bounds
// error 4: h\.smallest_size_in\(box\).*return-type|(constraint|because) 'std::convertible_to<dovetail::vec2
#include "dovetail/sizing/bounds.hpp"

struct my_sizing {
#if NEAR_MISS != 3
  double operator()(dovetail::vec3) const;
#endif
#if NEAR_MISS == 2
  double smallest_size_in(dovetail::vec3) const;
#elif NEAR_MISS == 4
  dovetail::vec2 smallest_size_in(const dovetail::box3&) const;
#elif NEAR_MISS != 1
  double smallest_size_in(const dovetail::box3&) const;
#endif
};

template <dovetail::bounded_below_sizing_field H>
void use(const H&) {}

void call() {
  use(my_sizing{});
}
