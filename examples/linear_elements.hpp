/// @file
/// Linear finite elements for -laplace(u) = f on tetrahedra, u given on the boundary; of examples 07 and 09.
#pragma once

#include "dovetail/adapters/eigen.hpp"
#include "dovetail/mesh/adjacency.hpp"

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include <vector>

/// Volume, centre, and the gradients of the four hat functions of a tetrahedron.
struct linear_element {
  double volume;
  Eigen::Vector3d centre;
  Eigen::Matrix<double, 3, 4> gradients;
};

inline linear_element element_of(const dovetail::simplicial_mesh<3>& mesh, Eigen::Index e) {
  const auto points = dovetail::as_matrix(mesh.points);     // n x 3, in place
  const auto elements = dovetail::as_matrix(mesh.elements); // m x 4, in place
  Eigen::Matrix4d corners;                                  // a row per vertex: 1, x, y, z
  for (int i = 0; i < 4; ++i)
    corners.row(i) << 1, points.row(elements(e, i));
  return {corners.determinant() / 6, corners.colwise().mean().tail<3>(), corners.inverse().bottomRows<3>()};
}

inline std::vector<bool> points_on_boundary(const dovetail::simplicial_mesh<3>& mesh) {
  std::vector<bool> found(mesh.points.size(), false);
  const auto sides = dovetail::build_sides(mesh);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<dovetail::local_id>(s)))
      for (const auto v : sides.vertices[s])
        found[v] = true;
  return found;
}

/// `Problem` has the values of u, `problem(x)`, of which those on the boundary are used, and
/// `problem.source(x)`.
template <class Problem>
Eigen::VectorXd solve(const dovetail::simplicial_mesh<3>& mesh, const Problem& problem) {
  const auto given = points_on_boundary(mesh);
  const auto points = dovetail::as_matrix(mesh.points);
  const auto elements = dovetail::as_matrix(mesh.elements);
  auto stiffness = dovetail::zero_matrix(mesh); // with the entries that linear elements need
  Eigen::VectorXd load = Eigen::VectorXd::Zero(points.rows());
  for (Eigen::Index e = 0; e < elements.rows(); ++e) {
    const auto element = element_of(mesh, e);
    for (int i = 0; i < 4; ++i) {
      const auto row = elements(e, i);
      if (given[row])
        continue;
      load[row] += element.volume / 4 * problem.source(element.centre);
      for (int j = 0; j < 4; ++j) {
        const auto column = elements(e, j);
        const double entry = element.volume * element.gradients.col(i).dot(element.gradients.col(j));
        if (given[column])
          load[row] -= entry * problem(points.row(column));
        else
          stiffness.coeffRef(row, column) += entry;
      }
    }
  }
  for (Eigen::Index p = 0; p < points.rows(); ++p)
    if (given[p]) {
      stiffness.coeffRef(p, p) = 1;
      load[p] = problem(points.row(p));
    }
  Eigen::ConjugateGradient<decltype(stiffness), Eigen::Lower | Eigen::Upper> solver(stiffness);
  return solver.solve(load);
}
