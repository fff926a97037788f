/// @file
/// The pipeline's result out of its skeleton and its meshed pieces.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"

#include <utility>

namespace dovetail::detail {

template <int D>
distributed_simplicial_mesh<D> assemble_mesh(const any_geometry& model, simplicial_skeleton<D> skeleton,
                                             const meshed_pieces<D>& meshed) {
  distributed_simplicial_mesh<D> mesh;
  mesh.skeleton = std::move(skeleton);
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
