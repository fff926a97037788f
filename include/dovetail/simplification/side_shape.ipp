/// @file
/// What `side_shape.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/side_table.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/simplification/side_shape.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<double> side_shapes(const simplicial_mesh<3>& mesh, const side_table<3>& sides) {
  std::vector<double> shapes(sides.size());
  for (std::size_t s = 0; s < sides.size(); ++s)
    shapes[s] = smallest_corner_angle(corners(span_of(mesh.points), sides.vertices[s]));
  return shapes;
}

DOVETAIL_INLINE std::vector<double> side_shapes(const simplicial_mesh<2>& mesh, const side_table<2>& sides) {
  std::vector<double> shapes(sides.size(), 180.0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto angles = dihedral_angles(corners(span_of(mesh.points), mesh.elements[e]));
    for (std::size_t r = 0; r < angles.size(); ++r)
      for (const int local : numbering::sides_of_ridge<2>[r]) {
        double& shape = shapes[sides.of_element[e][local]];
        shape = std::min(shape, angles[r]);
      }
  }
  return shapes;
}

} // namespace dovetail
