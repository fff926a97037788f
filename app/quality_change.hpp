/// @file
/// What a command made of the elements of a mesh.
#pragma once

#include "dovetail/mesh/quality.hpp"

namespace dovetail::app {

/// Prints a table of elements of a dimension before and after what took so many seconds.
void print_change(int dimension, const quality_statistics& before, const quality_statistics& after,
                  double seconds);

} // namespace dovetail::app
