// error: h\(p\).*invalid
#include "dovetail/sizing/concepts.hpp"

struct my_sizing {
#ifdef CORRECT
  double operator()(dovetail::vec3) const;
#else
  double operator()(double, double, double) const;
#endif
};

template <dovetail::sizing_field H>
void use(const H&) {}

void call() {
  use(my_sizing{});
}
