/// @file
/// Scripts that read what was written, run by tests.
#pragma once

#include "files/scratch_folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace dovetail::testing {

/// What a script ended with (0: nothing was wrong), and what it printed.
struct script_outcome {
  int status;
  std::string log;
};

/// Runs a script with its arguments; what it prints goes through a file in `folder`.
inline script_outcome run_script(const std::string& script_and_arguments,
                                 const std::filesystem::path& folder) {
  const auto log = folder / "check.txt";
  const std::string command = "/usr/bin/python3 " + script_and_arguments + " > '" + log.string() + "' 2>&1";
  const int status = std::system(command.c_str());
  return {status, file_content(log)};
}

} // namespace dovetail::testing
