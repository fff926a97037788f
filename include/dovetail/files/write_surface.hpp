/// @file
/// Writes a surface held in memory to an STL or OFF file.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <filesystem>

namespace dovetail::io {

/// Writes a binary STL file (single precision, 2^32 triangles at most). Throws `io_error` naming the path.
/// Linear.
/// \param mesh triangles
/// \param path the file, which is replaced
void write_stl(const simplicial_mesh<2>& mesh, const std::filesystem::path& path);

/// Writes an OFF file. Throws `io_error` naming the path.
/// Linear.
/// \param mesh triangles
/// \param path the file, which is replaced
void write_off(const simplicial_mesh<2>& mesh, const std::filesystem::path& path);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/write_surface.ipp"
#endif
