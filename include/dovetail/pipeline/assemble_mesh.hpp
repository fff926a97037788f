/// @file
/// The pipeline's result out of its skeleton and its meshed pieces.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// Gives triangles the numbers of the faces' members that their middles are on, and points inside of faces
/// the lowest one of those of their triangles.
inline void name_members(const any_geometry& model, fine_skeleton& skeleton) {
  const std::size_t faces = model.topology().faces.size();
  std::vector<bool> is_several(faces, false);
  for (std::size_t f = 0; f < faces; ++f)
    if (const auto member = static_cast<local_id>(f); model.whole_face(member) != member)
      is_several[model.whole_face(member)] = true;
  if (std::find(is_several.begin(), is_several.end(), true) == is_several.end())
    return;
  auto& of_sides = skeleton.side_hosts.own();
  auto& of_points = skeleton.point_hosts.own();
  std::vector<local_id> lowest(of_points.size(), no_id);
  for (std::size_t s = 0; s < of_sides.size(); ++s)
    if (const local_id f = of_sides[s]; f != no_id && is_several[f]) {
      const auto& [a, b, c] = skeleton.sides[s];
      of_sides[s] = model.face_at(f, (skeleton.points[a] + skeleton.points[b] + skeleton.points[c]) / 3);
      for (const local_id v : {a, b, c})
        lowest[v] = lowest[v] == no_id ? of_sides[s] : std::min(lowest[v], of_sides[s]);
    }
  for (std::size_t v = 0; v < of_points.size(); ++v)
    if (of_points[v].dimension == 2 && lowest[v] != no_id)
      of_points[v].id = lowest[v];
}

template <int D>
distributed_simplicial_mesh<D> assemble_mesh(const any_geometry& model, simplicial_skeleton<D> skeleton,
                                             const meshed_pieces<D>& meshed) {
  distributed_simplicial_mesh<D> mesh;
  mesh.skeleton = std::move(skeleton);
  if constexpr (D == 3)
    name_members(model, mesh.skeleton);
  for (const piece_summary& piece : meshed.pieces) {
    mesh.counts.push_back(piece.counts);
    mesh.quality.push_back(piece.quality);
  }
  mesh.load = meshed.load;
  mesh.release = meshed.release;
  mesh.released = meshed.released;
  for (const auto& solid : model.topology().solids)
    mesh.material_names.push_back(solid.name);
  for (const auto& face : model.topology().faces) {
    mesh.face_names.push_back(face.name);
    mesh.group_names.push_back(face.group);
  }
  return mesh;
}

} // namespace dovetail::detail
