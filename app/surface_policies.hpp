/// @file
/// The meshers of triangles by name.
#pragma once

#include "any_policies.hpp"

#include <string>
#include <vector>

namespace dovetail::app {

std::vector<std::string> surface_mesher_names();

/// The first one for an empty name. Throws `command_line_error` for a name that does not exist.
any_surface_mesher make_surface_mesher(const std::string& name);

} // namespace dovetail::app
