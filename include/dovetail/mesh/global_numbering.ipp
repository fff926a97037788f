/// @file
/// What `global_numbering.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/mid_nodes.hpp"

#include <cstddef>
#include <string>

namespace dovetail::io {

template <int D>
global_numbering number_globally(const distributed_simplicial_mesh<D>& mesh) {
  global_numbering numbers{{static_cast<global_id>(mesh.skeleton.points.size())}, {0}};
  for (const auto& piece : mesh.counts) {
    numbers.first_point.push_back(numbers.first_point.back() + piece.inner_points);
    numbers.first_element.push_back(numbers.first_element.back() + piece.elements);
  }
  return numbers;
}

template <int D>
global_numbering number_nodes(const distributed_simplicial_mesh<D>& mesh) {
  global_numbering numbers = number_globally(mesh);
  numbers.first_point = {static_cast<global_id>(skeleton_nodes(mesh))};
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    numbers.first_point.push_back(numbers.first_point.back() + inner_nodes(mesh, p));
  return numbers;
}

template <int D>
simplicial_piece<D> load_checked(const distributed_simplicial_mesh<D>& mesh, local_id index) {
  const auto refuse = [index](const char* what) {
    throw mesh_error("subdomain " + std::to_string(index) + ": " + what);
  };
  auto piece = mesh.load(index);
  const auto& counts = mesh.counts[index];
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

#ifdef DOVETAIL_COMPILED
template global_numbering number_globally<2>(const distributed_simplicial_mesh<2>& mesh);
template global_numbering number_nodes<2>(const distributed_simplicial_mesh<2>& mesh);
template simplicial_piece<2> load_checked<2>(const distributed_simplicial_mesh<2>& mesh, local_id index);
template global_numbering number_globally<3>(const distributed_simplicial_mesh<3>& mesh);
template global_numbering number_nodes<3>(const distributed_simplicial_mesh<3>& mesh);
template simplicial_piece<3> load_checked<3>(const distributed_simplicial_mesh<3>& mesh, local_id index);
#endif

} // namespace dovetail::io
