/// @file
/// Sizes for a number of elements: those of the model, scaled until so many are predicted.
#pragma once

#include "model_source.hpp"
#include "pipeline.hpp"

namespace dovetail::app {

/// By what to scale the sizes of the model so that about `elements` elements are predicted, within a few
/// percent of that number. `elements` is positive. Throws what planning throws.
template <int D>
double scale_for_elements(const model_source& source, double elements, const policies_of<D>& policies,
                          const generate_options& options);

/// The sizes of the model times a factor.
any_sizing scaled_sizes(const model_source& source, double factor);

/// Does that with the sizes of a model when a number is wanted.
template <int D>
void scale_to_elements(model_source& source, const model_options& wanted, const policies_of<D>& policies,
                       const generate_options& options);

} // namespace dovetail::app
