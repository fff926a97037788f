/// @file
/// What `dovetail experiment` is asked for, as plain data.
#pragma once

#include <string>
#include <vector>

namespace dovetail::app {

struct experiment_options {
  std::vector<std::string> names; ///< of experiments, or "all"
  std::string input;              ///< CAD or triangle file in place of the built-in models; empty: none
  double scale = 100;             ///< the paper's numbers of elements over those wanted
  int workers = 0;                ///< 0: as many as the machine has
  std::string out = "experiment";
  std::string command_line; ///< as it was given
  bool quiet = false;
};

} // namespace dovetail::app
