/// @file
/// Sides and ridges of a mesh together.
#pragma once

#include "dovetail/mesh/adjacency.hpp"

namespace dovetail_test {

template <int D>
struct adjacency {
  dovetail::side_table<D> sides;
  dovetail::ridge_table<D> ridges;

  std::size_t fan_count() const { return ridges.closed.size(); }
};

template <int D>
adjacency<D> build_adjacency(const dovetail::simplicial_mesh<D>& mesh) {
  auto sides = dovetail::build_sides(mesh);
  auto ridges = dovetail::build_ridges(mesh, sides);
  return {std::move(sides), std::move(ridges)};
}

} // namespace dovetail_test
