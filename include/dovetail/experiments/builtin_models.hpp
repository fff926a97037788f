/// @file
/// Models that need no file.
#pragma once

#include "dovetail/models/occt_model.hpp"
#include "dovetail/sizing/sources.hpp"

#include <string_view>
#include <vector>

namespace dovetail {

/// A model with the sizing that shows it: an ambient size and grid sources (possibly none), in its units.
struct builtin_model_result {
  occt_model model;                 ///< the model itself
  double size;                      ///< the ambient edge length
  std::vector<grid_source> sources; ///< what shows it, beside the ambient size
  dovetail::report report;          ///< what its making noted
};

/// A model as a list of them shows it.
struct builtin_model_info {
  std::string_view name;        ///< as `builtin_model` takes it
  std::string_view description; ///< in a few words
};

/// What `builtin_model` accepts.
std::vector<builtin_model_info> builtin_models();

/// Makes a built-in model. Throws `input_error` for an unknown name.
builtin_model_result builtin_model(std::string_view name);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED_OCCT
#include "dovetail/experiments/builtin_models.ipp"
#endif
