/// @file
/// What `loaded_mesh.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <string>
#include <vector>

namespace dovetail::io {

DOVETAIL_INLINE const std::vector<double>* loaded_mesh::scalars(const std::string& name) const {
  for (const auto& array : point_scalars)
    if (array.name == name)
      return &array.values;
  return nullptr;
}

} // namespace dovetail::io
