/// @file
/// The model and sizing field that a command line asks for.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "options.hpp"

#include "dovetail/core/report.hpp"
#include "dovetail/sizing/erased.hpp"

#include <string>

namespace dovetail::app {

struct model_source {
  std::string name; ///< for the summary
  any_geometry geometry;
  any_sizing size;
  report summary; ///< of reading and healing
  std::string
      sizing_meshes{}; ///< checksum of the meshes that the sizing file names; empty when it names none
};

/// Reads or builds the model and its sizing field. Throws `command_line_error` for options that contradict
/// each other, and the library's errors for files and sizes that cannot be used. For elements of dimension 2,
/// faces of a CAD file need not enclose solids.
model_source load_model(const model_options& options, int dimension = 3);

/// The sizing field of a JSON file, or the uniform one; empty when neither is given. A file may ask for sizes
/// from the model, if there is one. `meshes` receives the checksum of the meshes that the file names.
any_sizing load_sizing(const std::string& file, const std::optional<double>& size, const box3& domain,
                       const any_geometry* model = nullptr, std::string* meshes = nullptr);

} // namespace dovetail::app
