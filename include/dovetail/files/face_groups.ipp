/// @file
/// What `face_groups.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dovetail::io {

DOVETAIL_INLINE std::vector<std::string> collect_material_names(const distributed_mesh& mesh) {
  auto names = mesh.material_names;
  for (const auto& piece : mesh.counts)
    if (static_cast<std::size_t>(piece.material) >= names.size())
      names.resize(static_cast<std::size_t>(piece.material) + 1);
  for (std::size_t m = 0; m < names.size(); ++m)
    if (names[m].empty())
      names[m] = "region " + std::to_string(m + 1);
  return names;
}

} // namespace dovetail::io
