// near miss 1: it has no field of a box
// error 1: h\.within\(box\).*invalid|no member named 'within'
// near miss 2: the field of a box is of another type
// error 2: return-type-requirement|same_as<double, my_sizing>
// near miss 3: asking it changes it
// error 3: h\.within\(box\).*invalid|not marked const
#include "dovetail/sizing/bounds.hpp"

struct my_sizing {
  double operator()(dovetail::vec3) const;
#if NEAR_MISS == 2
  double within(const dovetail::box3&) const;
#elif NEAR_MISS == 3
  my_sizing within(const dovetail::box3&);
#elif NEAR_MISS != 1
  my_sizing within(const dovetail::box3&) const;
#endif
};

template <dovetail::narrowable_sizing_field H>
void use(const H&) {}

void call() {
  use(my_sizing{});
}
