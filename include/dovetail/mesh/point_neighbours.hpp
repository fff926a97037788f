/// @file
/// Which points of a mesh share an element.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dovetail {

/// Per point the points that share an element with it, itself included, ascending: the rows of the matrix
/// that linear elements assemble. A point without elements has an empty row. O(elements), but for sorting
/// each row.
/// Throws nothing but for a lack of memory; indices are not checked.
/// \param mesh triangles or tetrahedra
template <int D>
compressed_rows<local_id> point_neighbours(const simplicial_mesh<D>& mesh) {
  const auto elements = sorted_into_rows<local_id>(mesh.points.size(), [&](const auto& put) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (const local_id v : mesh.elements[e])
        put(v, static_cast<local_id>(e));
  });
  compressed_rows<local_id> neighbours;
  std::vector<local_id> row;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    row.clear();
    for (const local_id e : elements[p]) {
      const auto& vertices = mesh.elements[e];
      row.insert(row.end(), vertices.begin(), vertices.end());
    }
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    neighbours.items.insert(neighbours.items.end(), row.begin(), row.end());
    neighbours.begins.push_back(neighbours.items.size());
  }
  return neighbours;
}

} // namespace dovetail
