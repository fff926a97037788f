// near miss 1: it measures in double precision only
// error 1: M::of_apex\(f, f, f\).*(invalid|return-type)|no matching function|no viable conversion
// near miss 2: it does not say which value an angle has
// error 2: M::from_angle\(angle\).*invalid|no member named 'from_angle'
// near miss 3: it always answers in double precision
// error 3: M::of_apex\(f, f, f\).*return-type|(constraint|because) 'std::same_as<double, float>
#include "dovetail/improver/shape_measure.hpp"

using dovetail::improvement::triple;

struct my_measure {
#if NEAR_MISS == 1
  static double of_apex(triple<double> a, triple<double> b, triple<double> c);
#elif NEAR_MISS == 3
  template <class T>
  static double of_apex(triple<T> a, triple<T> b, triple<T> c);
#else
  template <class T>
  static T of_apex(triple<T> a, triple<T> b, triple<T> c);
#endif
#if NEAR_MISS != 2
  static double from_angle(double degrees);
#endif
};

template <dovetail::improvement::shape_measure M>
void use(const M&) {}

void call() {
  use(my_measure{});
}
