/// @file
/// What tests measure of meshes of tetrahedra.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/quality.hpp"

namespace dovetail::testing {

inline double volume_of(const simplicial_mesh<3>& mesh) {
  double sum = 0;
  const auto at = [&](local_id v) { return mesh.points[v]; };
  for (const auto& [a, b, c, d] : mesh.elements)
    sum += signed_volume(at(a), at(b), at(c), at(d));
  return sum;
}

inline double volume_of(const distributed_mesh& mesh) {
  double sum = 0;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    sum += volume_of(mesh.load(static_cast<local_id>(p)).mesh);
  return sum;
}

} // namespace dovetail::testing
