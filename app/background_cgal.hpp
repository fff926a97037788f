/// @file
/// CGAL's Mesh_3 for the driver, in a file of its own as it takes long to compile.
#pragma once

#include "any_background_mesher.hpp"

namespace dovetail::app {

any_background_mesher cgal_background_mesher();

} // namespace dovetail::app
