#include "sizes_for_elements.hpp"

#include "dovetail/sizing/compose.hpp"

#include <cmath>

namespace dovetail::app {

template <int D>
double scale_for_elements(const model_source& source, double elements, const policies_of<D>& policies,
                          const generate_options& options) {
  double factor = 1;
  // The number goes with a power of the size but for gradation and walls, so a second step is close.
  for (int step = 0; step < 2; ++step) {
    const any_sizing size = scaled_sizes(source, factor);
    factor *= std::pow(
        plan_generation<D>(source.geometry, size, policies, options).predicted_elements / elements, 1.0 / D);
  }
  return factor;
}

any_sizing scaled_sizes(const model_source& source, double factor) {
  return keep_bounds(scaled<any_sizing>(source.size, factor));
}

template <int D>
void scale_to_elements(model_source& source, const model_options& wanted, const policies_of<D>& policies,
                       const generate_options& options) {
  if (!wanted.elements)
    return;
  generate_options unbounded = options;
  unbounded.enlarged_above = 0;
  source.size = scaled_sizes(source, scale_for_elements<D>(source, *wanted.elements, policies, unbounded));
}

template double scale_for_elements(const model_source&, double, const policies_of<3>&,
                                   const generate_options&);
template double scale_for_elements(const model_source&, double, const policies_of<2>&,
                                   const generate_options&);
template void scale_to_elements(model_source&, const model_options&, const policies_of<3>&,
                                const generate_options&);
template void scale_to_elements(model_source&, const model_options&, const policies_of<2>&,
                                const generate_options&);

} // namespace dovetail::app
