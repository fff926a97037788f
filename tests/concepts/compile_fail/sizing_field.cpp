// near miss 1: it takes coordinates, not a point
// error 1: h\(p\).*invalid|no matching function for call to object of type 'const my_sizing
// near miss 2: it returns a vector (a size per direction)
// error 2: h\(p\).*return-type|(constraint|because) 'std::convertible_to<dovetail::vec3
// near miss 3: evaluation is not const
// error 3: h\(p\).*invalid|no matching function for call to object of type 'const my_sizing
#include "dovetail/sizing/concepts.hpp"

struct my_sizing {
#if NEAR_MISS == 1
  double operator()(double, double, double) const;
#elif NEAR_MISS == 2
  dovetail::vec3 operator()(dovetail::vec3) const;
#elif NEAR_MISS == 3
  double operator()(dovetail::vec3);
#else
  double operator()(dovetail::vec3) const;
#endif
};

template <dovetail::sizing_field H>
void use(const H&) {}

void call() {
  use(my_sizing{});
}
