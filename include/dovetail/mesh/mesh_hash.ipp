/// @file
/// What `mesh_hash.hpp` declares.
#pragma once

#include "dovetail/core/hash.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/mesh_hash.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace dovetail::io {

DOVETAIL_INLINE void mesh_hasher::point(global_id id, vec3 at) {
  content_hash hash;
  hash.word(static_cast<std::uint64_t>(id));
  for (int axis = 0; axis < 3; ++axis)
    hash.number(at[axis]);
  sum_ += hash.value();
}

DOVETAIL_INLINE std::uint64_t mesh_hash(const loaded_mesh& loaded) {
  const bool numbered = loaded.node_ids.size() == loaded.mesh.points.size();
  const auto id = [&](local_id v) { return numbered ? loaded.node_ids[v] : v; };
  mesh_hasher hasher;
  for (std::size_t v = 0; v < loaded.mesh.points.size(); ++v)
    hasher.point(id(static_cast<local_id>(v)), loaded.mesh.points[v]);
  for (const auto& e : loaded.mesh.elements)
    hasher.element(std::array<global_id, 4>{id(e[0]), id(e[1]), id(e[2]), id(e[3])});
  for (std::size_t t = 0; loaded.mesh.elements.empty() && t < loaded.triangles.size(); ++t) {
    const auto& [a, b, c] = loaded.triangles[t];
    hasher.element(std::array<global_id, 3>{id(a), id(b), id(c)});
  }
  return hasher.value();
}

} // namespace dovetail::io
