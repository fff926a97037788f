/// @file
/// Global numbers of a distributed mesh: one exclusive scan over the counts of its pieces.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/mid_nodes.hpp"

#include <string>
#include <vector>

namespace dovetail::io {

/// Where the numbers of each piece start. Entry `pieces` of each array is the total.
struct global_numbering {
  std::vector<global_id> first_point;   ///< global number of a piece's first inner point
  std::vector<global_id> first_element; ///< global number of a piece's first element

  global_id points() const { return first_point.back(); }     ///< of the whole mesh
  global_id elements() const { return first_element.back(); } ///< of the whole mesh
};

/// O(pieces).
template <int D>
global_numbering number_globally(const distributed_simplicial_mesh<D>& mesh) {
  global_numbering numbers{{static_cast<global_id>(mesh.skeleton.points.size())}, {0}};
  for (const auto& piece : mesh.counts) {
    numbers.first_point.push_back(numbers.first_point.back() + piece.inner_points);
    numbers.first_element.push_back(numbers.first_element.back() + piece.elements);
  }
  return numbers;
}

/// The same for nodes: `points()` counts those in the middle of edges too, and `first_point` is the number of
/// a piece's first own node.
template <int D>
global_numbering number_nodes(const distributed_simplicial_mesh<D>& mesh) {
  global_numbering numbers = number_globally(mesh);
  numbers.first_point = {static_cast<global_id>(skeleton_nodes(mesh))};
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    numbers.first_point.push_back(numbers.first_point.back() + inner_nodes(mesh, p));
  return numbers;
}

/// Loads a piece and checks it against its counts and the skeleton, so that consumers may index freely;
/// throws `mesh_error` naming the subdomain when they disagree. O(size of the piece).
template <int D>
simplicial_piece<D> load_checked(const distributed_simplicial_mesh<D>& mesh, local_id index) {
  const auto refuse = [index](const char* what) {
    throw mesh_error("subdomain " + std::to_string(index) + ": " + what);
  };
  auto piece = mesh.load(index);
  const auto& counts = mesh.counts[static_cast<std::size_t>(index)];
  const auto points = static_cast<local_id>(piece.mesh.points.size());
  const auto shared = piece.skeleton_points.size();
  if (piece.subdomain != index)
    refuse("the loaded piece belongs to another subdomain");
  if (static_cast<global_id>(piece.mesh.elements.size()) != counts.elements ||
      points - static_cast<global_id>(shared) != counts.inner_points)
    refuse("the loaded piece has other counts than announced");
  for (const auto s : piece.skeleton_points)
    if (s < 0 || static_cast<std::size_t>(s) >= mesh.skeleton.points.size())
      refuse("a skeleton point is out of range");
  for (const auto& element : piece.mesh.elements)
    for (const auto v : element)
      if (v < 0 || v >= points)
        refuse("an element refers to a point that does not exist");
  return piece;
}

/// The global number of node `i` of a piece.
template <int D>
global_id global_node(const piece_nodes<D>& nodes, const global_numbering& numbers, local_id piece,
                      local_id i) {
  const auto shared = static_cast<local_id>(nodes.shared().size());
  return i < shared ? nodes.shared()[static_cast<std::size_t>(i)]
                    : numbers.first_point[static_cast<std::size_t>(piece)] + (i - shared);
}

/// The global number of point `i` of a piece.
template <int D>
global_id global_point(const simplicial_piece<D>& piece, const global_numbering& numbers, local_id i) {
  const auto shared = static_cast<local_id>(piece.skeleton_points.size());
  if (i < shared)
    return piece.skeleton_points[static_cast<std::size_t>(i)];
  return numbers.first_point[static_cast<std::size_t>(piece.subdomain)] + (i - shared);
}

} // namespace dovetail::io
