// near miss 1: it does not know its features
// error 1: h\.feature_size\(p\).*invalid|no member named 'feature_size'
// near miss 2: it knows one feature size for all places
// error 2: h\.feature_size\(p\).*invalid|too many arguments
// near miss 3: asking it changes it
// error 3: h\.feature_size\(p\).*invalid|not marked const
#include "dovetail/sizing/bounds.hpp"

struct my_sizing {
  double operator()(dovetail::vec3) const;
#if NEAR_MISS == 2
  double feature_size() const;
#elif NEAR_MISS == 3
  double feature_size(dovetail::vec3);
#elif NEAR_MISS != 1
  double feature_size(dovetail::vec3) const;
#endif
};

template <dovetail::feature_aware_sizing_field H>
void use(const H&) {}

void call() {
  use(my_sizing{});
}
