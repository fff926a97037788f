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

/// The executor of a name; meshers of triangles run in all of them. Throws `command_line_error`.
any_executor make_surface_executor(const std::string& name, int workers);

} // namespace dovetail::app
