/// @file
/// The named groups of a mesh's boundary faces: what a solver hangs its boundary conditions on.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace dovetail::io {

/// Groups in the order of their first CAD face.
struct face_groups {
  std::vector<std::string> names; ///< distinct, none empty
  std::vector<local_id> of_face;  ///< per CAD face: its group
};

/// Puts CAD faces of one name into one group, those with names or sides and at least `faces`. A face without
/// a group makes a group of its own, called by the face's name, or "face N", its index in the model, when it
/// has none. O(faces log faces).
template <int D>
face_groups collect_face_groups(const distributed_simplicial_mesh<D>& mesh, std::size_t faces = 0) {
  faces = std::max({faces, mesh.group_names.size(), mesh.face_names.size()});
  if constexpr (D == 3) // in D = 2 sides lie on curves
    for (const auto f : mesh.skeleton.side_hosts)
      faces = std::max(faces, static_cast<std::size_t>(f + 1));
  face_groups groups;
  std::vector<local_id> by_name; // the groups in the order of their names
  for (std::size_t f = 0; f < faces; ++f) {
    std::string name = f < mesh.group_names.size() ? mesh.group_names[f] : "";
    if (name.empty() && f < mesh.face_names.size())
      name = mesh.face_names[f];
    if (name.empty())
      name = "face " + std::to_string(f);
    const auto at = std::lower_bound(by_name.begin(), by_name.end(), name,
                                     [&](local_id p, const std::string& n) { return groups.names[p] < n; });
    if (at != by_name.end() && groups.names[*at] == name) {
      groups.of_face.push_back(*at);
      continue;
    }
    const auto made = static_cast<local_id>(groups.names.size());
    by_name.insert(at, made);
    groups.names.push_back(name);
    groups.of_face.push_back(made);
  }
  return groups;
}

/// The name of every material: the given one, or "region N" (N counted from 1).
std::vector<std::string> collect_material_names(const distributed_mesh& mesh);

/// Names of the tags of elements: materials, or in D = 2 CAD faces.
inline std::vector<std::string> names_of_tags(const distributed_simplicial_mesh<3>& mesh) {
  return collect_material_names(mesh);
}
inline std::vector<std::string> names_of_tags(const distributed_simplicial_mesh<2>& mesh) {
  return mesh.face_names;
}

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/face_groups.ipp"
#endif
