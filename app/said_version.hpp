/// @file
/// The program's version as text.
#pragma once

#include "dovetail/core/version.hpp"

#include <string>

namespace dovetail::app {

/// As `dovetail --version` says it.
inline std::string said_version() {
  return std::string("dovetail ") + version + " (meshes of revision " + std::to_string(mesh_revision) + ")";
}

} // namespace dovetail::app
