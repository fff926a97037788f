/// @file
/// CGAL's improver for the driver, in a file of its own as it takes long to compile.
#pragma once

#include "named_improver.hpp"

namespace dovetail::app {

named_improver cgal_improver();

} // namespace dovetail::app
