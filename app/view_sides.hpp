/// @file
/// Which sides of tetrahedra are seen: those outside, and those between pieces or with a group.
#pragma once

#include "dovetail/mesh/loaded_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace dovetail::app {

/// A side as one of its elements has it.
struct seen_side {
  simplex<2> vertices; ///< oriented outwards of the element
  local_id element;
  std::optional<local_id> tag; ///< of the file's triangle there
};

/// Each in the order of their vertices.
struct seen_sides {
  std::vector<seen_side> outer; ///< with one element
  std::vector<seen_side> inner; ///< once for each of their elements
};

/// Sides of more than two elements are seen too. Memory is that of the sides found, of the points, and of a
/// bounded number of other sides, since a table of all sides of a large mesh takes more than the mesh. Throws
/// `mesh_error` where an element names a point that there is not.
/// \param pieces,materials per element; what is between different ones is seen
seen_sides find_seen_sides(const io::loaded_mesh& mesh, std::span<const local_id> pieces,
                           std::span<const local_id> materials);

/// Calls `visit` for each side with 4 * element + local side of each of its elements, in the lexicographic
/// order of vertices.
/// \param most sides of elements that are in memory at a time, unless one point has more
void for_each_side(std::span<const simplex<3>> elements, std::size_t points,
                   const std::function<void(std::span<const std::uint32_t>)>& visit,
                   std::size_t most = std::size_t{1} << 24U);

} // namespace dovetail::app
