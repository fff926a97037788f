/// @file
/// The named boundary patches of a mesh: what a solver hangs its boundary conditions on.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace dovetail::io {

/// Patches in the order of their first CAD face.
struct boundary_patches {
  std::vector<std::string> names; ///< distinct, none empty
  std::vector<local_id> of_face;  ///< per CAD face: its patch
};

/// Groups CAD faces by patch name, those with names or sides and at least `faces`. A face without a patch
/// makes a patch of its own, called by the face's name, or "face N" (N counted from 1) when it has none.
/// O(faces log faces).
template <int D>
boundary_patches collect_patches(const distributed_simplicial_mesh<D>& mesh, std::size_t faces = 0) {
  faces = std::max({faces, mesh.patch_names.size(), mesh.face_names.size()});
  if constexpr (D == 3) // in D = 2 sides lie on curves
    for (const auto f : mesh.skeleton.side_hosts)
      faces = std::max(faces, static_cast<std::size_t>(f + 1));
  boundary_patches patches;
  std::vector<local_id> by_name; // the patches in the order of their names
  for (std::size_t f = 0; f < faces; ++f) {
    std::string name = f < mesh.patch_names.size() ? mesh.patch_names[f] : "";
    if (name.empty() && f < mesh.face_names.size())
      name = mesh.face_names[f];
    if (name.empty())
      name = "face " + std::to_string(f + 1);
    const auto at =
        std::lower_bound(by_name.begin(), by_name.end(), name, [&](local_id p, const std::string& n) {
          return patches.names[static_cast<std::size_t>(p)] < n;
        });
    if (at != by_name.end() && patches.names[static_cast<std::size_t>(*at)] == name) {
      patches.of_face.push_back(*at);
      continue;
    }
    const auto made = static_cast<local_id>(patches.names.size());
    by_name.insert(at, made);
    patches.names.push_back(name);
    patches.of_face.push_back(made);
  }
  return patches;
}

/// The name of every material: the given one, or "region N" (N counted from 1).
inline std::vector<std::string> collect_material_names(const distributed_mesh& mesh) {
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
