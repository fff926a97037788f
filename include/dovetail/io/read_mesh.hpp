/// @file
/// Reads a mesh of any format that is known, which is told from the file's first bytes.
#pragma once

#include "dovetail/io/msh_reader.hpp"
#include "dovetail/io/vtu_reader.hpp"

#include <filesystem>
#include <string>

namespace dovetail::io {

/// Reads a VTU, PVTU or MSH file; of a folder, the PVTU or MSH file in it. `expand` is for compressed arrays,
/// see `vtu_reader`. Throws `input_error` naming the file and what is wrong with it.
inline loaded_mesh read_mesh(const std::filesystem::path& path, vtk_expander expand = nullptr) {
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure)) {
    std::filesystem::path found;
    for (const auto& entry : std::filesystem::directory_iterator(path, failure))
      if (const auto extension = entry.path().extension(); extension == ".pvtu" || extension == ".msh")
        if (found.empty() || (extension == ".pvtu" && found.extension() != ".pvtu") ||
            (extension == found.extension() && entry.path() < found))
          found = entry.path();
    if (found.empty())
      throw input_error(path.string() + ": there is no .pvtu or .msh file in this folder");
    return read_mesh(found, expand);
  }
  const auto start = read_file(path, 256);
  if (start.find("$MeshFormat") != std::string::npos)
    return msh_reader{}(path);
  if (start.find("<?xml") != std::string::npos || start.find("<VTKFile") != std::string::npos)
    return vtu_reader{expand}(path);
  throw input_error(path.string() + ": this is no mesh file that is known: neither VTU, PVTU nor MSH");
}

} // namespace dovetail::io
