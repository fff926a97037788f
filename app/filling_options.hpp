/// @file
/// What the command line asks for when the inside of a surface is to be meshed.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dovetail::app {

struct filling_options {
  std::string input; ///< a file with triangles
  std::string out;
  std::optional<double> size;
  std::string sizing; ///< JSON file with a sizing field
  std::optional<double> growth;
  std::vector<std::string> voids; ///< points of regions to leave empty, as "x,y,z"
  std::string mesher;
  std::string improver;
  int workers = 0; ///< 0: as many as the machine has
  std::string report;
  bool quiet = false;
};

} // namespace dovetail::app
