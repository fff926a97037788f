/// @file
/// Meshes as Eigen sees them: points and elements as matrices without a copy, and the matrix to assemble.
#pragma once

#include "dovetail/mesh/point_neighbours.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <cstddef>
#include <vector>

namespace dovetail {

/// Points as the rows of an n x 3 matrix, in place: valid as long as the vector is neither resized nor gone.
/// Constant time. Throws nothing.
/// \param points of a mesh, such as `mesh.points`
inline auto as_matrix(const std::vector<vec3>& points) {
  static_assert(sizeof(vec3) == 3 * sizeof(double));
  using matrix = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const matrix>(points.empty() ? nullptr : &points.front().x,
                                  static_cast<Eigen::Index>(points.size()), 3);
}

/// Elements or sides as the rows of an n x (number of vertices) matrix, in place, as above.
/// \param simplices such as `mesh.elements`
template <std::size_t Vertices>
auto as_matrix(const std::vector<std::array<local_id, Vertices>>& simplices) {
  using matrix = Eigen::Matrix<local_id, Eigen::Dynamic, static_cast<int>(Vertices), Eigen::RowMajor>;
  return Eigen::Map<const matrix>(simplices.empty() ? nullptr : simplices.front().data(),
                                  static_cast<Eigen::Index>(simplices.size()),
                                  static_cast<Eigen::Index>(Vertices));
}

/// The matrix that linear elements assemble, compressed, of zeros: a row and a column per point, an entry per
/// pair of points of an element, so that `coeffRef(i, j) += x` allocates nothing. O(elements).
/// Throws nothing but for a lack of memory.
/// \param mesh triangles or tetrahedra
template <int D>
Eigen::SparseMatrix<double, Eigen::RowMajor> zero_matrix(const simplicial_mesh<D>& mesh) {
  const auto rows = point_neighbours(mesh);
  const auto points = static_cast<Eigen::Index>(rows.size());
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(points, points);
  matrix.reserve(static_cast<Eigen::Index>(rows.items.size()));
  for (std::size_t p = 0; p < rows.size(); ++p) {
    matrix.startVec(static_cast<Eigen::Index>(p));
    for (const local_id q : rows[p])
      matrix.insertBack(static_cast<Eigen::Index>(p), q) = 0;
  }
  matrix.finalize();
  return matrix;
}

} // namespace dovetail
