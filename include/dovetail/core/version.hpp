/// @file
/// The version of the library, and of the meshes that it makes. The build reads the first from here.
#pragma once

#define DOVETAIL_VERSION_MAJOR 0
#define DOVETAIL_VERSION_MINOR 2
#define DOVETAIL_VERSION_PATCH 0

namespace dovetail {

/// The version as text, "major.minor.patch"; part of the manifest of a spool folder.
inline constexpr const char* version = "0.2.0";

/// One more with each change by which a mesh is another one for the same input; docs/mesh_changes.md lists
/// them.
inline constexpr int mesh_revision = 26;

} // namespace dovetail
