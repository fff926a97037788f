/// @file
/// Points that no element uses.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cstddef>
#include <vector>

namespace dovetail {

/// Removes the points after the first `kept` that no element uses; the others keep their order. O(n).
template <int D>
void drop_unused_points(simplicial_mesh<D>& mesh, std::size_t kept = 0) {
  std::vector<local_id> number(mesh.points.size(), no_id);
  for (const simplex<D>& element : mesh.elements)
    for (const local_id v : element)
      number[v] = v;
  std::size_t next = kept;
  for (std::size_t v = kept; v < number.size(); ++v)
    if (number[v] != no_id) {
      mesh.points[next] = mesh.points[v];
      number[v] = static_cast<local_id>(next++);
    }
  if (next == mesh.points.size())
    return;
  mesh.points.resize(next);
  for (simplex<D>& element : mesh.elements)
    for (local_id& v : element)
      if (static_cast<std::size_t>(v) >= kept)
        v = number[v];
}

} // namespace dovetail
