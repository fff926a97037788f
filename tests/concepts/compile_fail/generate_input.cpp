// near miss 1: a file name in place of a model
// first error 1: takes a geometry_model
// near miss 2: a number in place of sizes
// first error 2: takes a sizing_field
// near miss 3: sizes that depend on no place
// first error 3: takes a sizing_field
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

void call(const dovetail::plane_domain& model) {
  using namespace dovetail;
#if NEAR_MISS == 1
  generate<2>("wing.step", uniform_size(1), parameters<>{});
#elif NEAR_MISS == 2
  generate<2>(model, 0.1, parameters<>{});
#elif NEAR_MISS == 3
  generate<2>(
      model, [] { return 0.1; }, parameters<>{});
#else
  generate<2>(model, uniform_size(1), parameters<>{});
#endif
}
