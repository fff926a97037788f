/// @file
/// Either kind of MSH file.
#pragma once

#include "dovetail/files/msh_writer.hpp"

namespace dovetail::testing {

/// Writes `mesh.msh`; ghosts go into a partitioned one only.
inline void write_kind_of_msh(const distributed_mesh& mesh, const std::filesystem::path& folder,
                              bool partitioned, bool ghosts = false, bool binary = true) {
  if (partitioned)
    io::partitioned_msh_writer{.ghosts = ghosts, .binary = binary, .stem = "mesh"}(mesh, folder);
  else
    io::msh_writer{.binary = binary}(mesh, folder);
}

} // namespace dovetail::testing
