#include "sizes_for_elements.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/sizing/compose.hpp"

#include <cmath>
#include <limits>

namespace dovetail::app {
namespace {

any_sizing times(const any_sizing& size, double factor) {
  return keep_bounds(scaled<any_sizing>(size, factor));
}

} // namespace

template <int D>
size_scale scale_for_elements(const model_source& source, double elements, const policies_of<D>& policies,
                              const generate_options& options) {
  constexpr double close = 0.03;
  const auto plan_times = plan_multiples_of<D>(source.geometry, source.size, policies, options);
  size_scale best;
  double factor = 1, least_off = std::numeric_limits<double>::infinity();
  double too_large = std::numeric_limits<double>::infinity();
  // The number goes with a power of the size but for gradation and walls; what small features need it does
  // not get below, and larger sizes may only give it worse triangles.
  int planned = 0;
  for (int step = 0; step < 12 && planned < 4 && least_off > close; ++step) {
    double predicted = 0;
    try {
      predicted = plan_times(factor).predicted_elements;
    } catch (const sizing_error&) { // larger than the model, or smaller than any machine can hold
      if (planned == 0 || factor < best.factor)
        throw;
      too_large = factor;
      factor = std::sqrt(best.factor * too_large);
      continue;
    }
    ++planned;
    if (const double off = std::abs(std::log(predicted / elements)); off < least_off) {
      least_off = off;
      best = {factor, predicted};
    }
    factor *= std::pow(predicted / elements, 1.0 / D);
    if (factor >= too_large)
      factor = std::sqrt(best.factor * too_large);
  }
  return best;
}

any_sizing scaled_sizes(const model_source& source, double factor) {
  return times(source.size, factor);
}

template <int D>
void scale_to_elements(model_source& source, const model_options& wanted, const policies_of<D>& policies,
                       const generate_options& options) {
  if (!wanted.elements)
    return;
  generate_options unbounded = options;
  unbounded.enlarged_above = 0;
  const size_scale found = scale_for_elements<D>(source, *wanted.elements, policies, unbounded);
  source.size = scaled_sizes(source, found.factor);
  if (source.size_of_details)
    source.size_of_details = times(source.size_of_details, found.factor);
  if (const double off = found.predicted_elements / *wanted.elements; off > 1.2 || off < 1 / 1.2)
    source.summary.warnings.push_back("about " + number_text(*wanted.elements, 3) +
                                      " elements were asked for, and about " +
                                      number_text(found.predicted_elements, 3) + " are predicted at best" +
                                      (off > 1 ? ", however large the sizes" : ""));
}

template size_scale scale_for_elements(const model_source&, double, const policies_of<3>&,
                                       const generate_options&);
template size_scale scale_for_elements(const model_source&, double, const policies_of<2>&,
                                       const generate_options&);
template void scale_to_elements(model_source&, const model_options&, const policies_of<3>&,
                                const generate_options&);
template void scale_to_elements(model_source&, const model_options&, const policies_of<2>&,
                                const generate_options&);

} // namespace dovetail::app
