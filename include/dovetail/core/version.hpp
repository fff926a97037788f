/// @file
/// The version of the library. The build reads it from here.
#pragma once

#define DOVETAIL_VERSION_MAJOR 0
#define DOVETAIL_VERSION_MINOR 2
#define DOVETAIL_VERSION_PATCH 0

namespace dovetail {

/// The version as text, "major.minor.patch"; part of the manifest of a spool folder.
inline constexpr const char* version = "0.2.0";

} // namespace dovetail
