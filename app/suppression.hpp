/// @file
/// The model as it is meshed: without details that are far smaller than the sizes.
#pragma once

#include "model_source.hpp"
#include "options.hpp"

namespace dovetail::app {

/// Takes the details away that the options and the final sizes of the source say, and notes that in its
/// summary. Throws `command_line_error` for a length that is none.
void suppress_details(model_source& source, const model_options& options);

} // namespace dovetail::app
