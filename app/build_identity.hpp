/// @file
/// Which build of the driver this is: another one may make another mesh.
#pragma once

#include "dovetail/parallel/spool.hpp"

namespace dovetail::app {

/// Checksums of the program and of the shared libraries that it runs with.
run_identity identity_of_build();

} // namespace dovetail::app
