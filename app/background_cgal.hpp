/// @file
/// CGAL's Mesh_3 for the driver, in a file of its own as it takes long to compile.
#pragma once

#include "dovetail/mesher/any_line_keeping_mesher.hpp"

namespace dovetail::app {

any_line_keeping_mesher cgal_background_mesher();

} // namespace dovetail::app
