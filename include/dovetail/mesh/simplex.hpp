/// @file
/// Canonical numbering of simplices of dimension 1 to 3.
///
/// Side i of an element is opposite its vertex i. The sides of a positively oriented element are listed so
/// that their normals point outwards (D = 3) or that the element lies to their left (D = 2).
#pragma once

#include "dovetail/core/ids.hpp"

#include <array>
#include <cstddef>

namespace dovetail {

/// Vertex ids of a D-simplex; a positively oriented tetrahedron (a, b, c, d) has (b-a) x (c-a) . (d-a) > 0.
template <int D>
using simplex = std::array<local_id, static_cast<std::size_t>(D) + 1>;

namespace numbering {

/// `sides<D>[i]` lists the local vertices of side i.
template <int D>
inline constexpr auto sides = [] {
  if constexpr (D == 1)
    return std::array<std::array<int, 1>, 2>{{{1}, {0}}};
  else if constexpr (D == 2)
    return std::array<std::array<int, 2>, 3>{{{1, 2}, {2, 0}, {0, 1}}};
  else
    return std::array<std::array<int, 3>, 4>{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
}();

/// `ridges<D>[r]` lists the local vertices of ridge r (dimension D-2).
template <int D>
inline constexpr auto ridges = [] {
  if constexpr (D == 2)
    return std::array<std::array<int, 1>, 3>{{{0}, {1}, {2}}};
  else
    return std::array<std::array<int, 2>, 6>{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
}();

/// `sides_of_ridge<D>[r]` lists the two sides that meet at ridge r; together they make the dihedral at r.
template <int D>
inline constexpr auto sides_of_ridge = [] {
  if constexpr (D == 2)
    return std::array<std::array<int, 2>, 3>{{{1, 2}, {2, 0}, {0, 1}}};
  else
    return std::array<std::array<int, 2>, 6>{{{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}};
}();

} // namespace numbering
} // namespace dovetail
