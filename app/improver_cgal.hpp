/// @file
/// CGAL's improver for the driver, in a file of its own as it takes long to compile.
#pragma once

#include "any_policies.hpp"

namespace dovetail::app {

any_improver cgal_improver();

} // namespace dovetail::app
