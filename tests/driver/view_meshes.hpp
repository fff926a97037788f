/// @file
/// Small meshes to look at.
#pragma once

#include "dovetail/mesh/loaded_mesh.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace dovetail::app::testing {

/// `cubes` unit cubes in a row along x, each of six tetrahedra around the diagonal from its lowest corner.
inline io::loaded_mesh row_of_cubes(local_id cubes) {
  io::loaded_mesh row;
  for (local_id x = 0; x <= cubes; ++x)
    for (int corner = 0; corner < 4; ++corner)
      row.mesh.points.push_back({static_cast<double>(x), corner % 2 ? 1.0 : 0.0, corner / 2 ? 1.0 : 0.0});
  constexpr std::array<std::array<int, 3>, 6> paths{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
  constexpr std::array<local_id, 3> step{4, 1, 2}; // in x, y and z
  for (local_id cube = 0; cube < cubes; ++cube)
    for (std::size_t p = 0; p < paths.size(); ++p) {
      simplex<3> element{4 * cube};
      for (std::size_t k = 0; k < 3; ++k)
        element[k + 1] = element[k] + step[paths[p][k]];
      if (p >= 3) // an odd order of the axes
        std::swap(element[2], element[3]);
      row.mesh.elements.push_back(element);
    }
  return row;
}

/// The same, each cube a subdomain.
inline io::loaded_mesh cubes_in_pieces(local_id cubes) {
  io::loaded_mesh row = row_of_cubes(cubes);
  for (std::size_t e = 0; e < row.mesh.elements.size(); ++e)
    row.subdomains.push_back(static_cast<local_id>(e / 6));
  return row;
}

/// The square from 0 to 2 in x and 0 to 1 in y, in two groups.
inline io::loaded_mesh two_squares() {
  io::loaded_mesh flat;
  flat.mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  flat.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  flat.triangle_tags = {7, 7, 9, 9};
  flat.triangle_names = {{9, "right"}};
  return flat;
}

} // namespace dovetail::app::testing
