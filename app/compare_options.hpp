/// @file
/// What `dovetail compare` is asked for.
#pragma once

#include "options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace CLI { // NOLINT: the name is CLI11's
class App;
}

namespace dovetail::app {

/// Every combination of the four lists is run. An empty list stands for the default policy, of simplifiers
/// for the paper's and none.
struct compare_options {
  model_options model;
  int dimension = 3; ///< of the elements
  std::vector<std::string> partitioners;
  std::vector<std::string> meshers;
  std::vector<std::string> improvers;
  std::vector<std::string> simplifiers;
  std::optional<int> subdomains;
  std::optional<double> coarsening;
  int workers = 0;
  std::string executor;
  std::string out = "compare";
  std::string command_line; ///< as it was given
  bool quiet = false;
};

/// Adds the options of the command but those of the model, which must be there already.
void add_compare_options(CLI::App& command, compare_options& options);

} // namespace dovetail::app
