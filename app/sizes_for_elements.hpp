/// @file
/// Sizes for a number of elements: those of the model, scaled until so many are predicted.
#pragma once

#include "model_source.hpp"
#include "pipeline.hpp"

namespace dovetail::app {

/// A factor of sizes, and what they predict.
struct size_scale {
  double factor = 1;
  double predicted_elements = 0;
};

/// By what to scale the sizes of the model so that `elements` elements, a positive number, are predicted:
/// within 3 percent, or the best of four attempts where the model's features need more than that. Throws what
/// planning throws.
template <int D>
size_scale scale_for_elements(const model_source& source, double elements, const policies_of<D>& policies,
                              const generate_options& options);

/// The sizes of the model times a factor.
any_sizing scaled_sizes(const model_source& source, double factor);

/// Does that with the sizes of a model when a number is wanted; warns where the prediction is 20 percent off.
template <int D>
void scale_to_elements(model_source& source, const model_options& wanted, const policies_of<D>& policies,
                       const generate_options& options);

} // namespace dovetail::app
