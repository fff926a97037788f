/// Linear finite elements from a CAD file with Eigen: -laplace(u) = f with u given on the boundary, solved at
/// two sizes. The error of a method of second order falls to a quarter. Usage: 07_poisson FILE [SIZE]
#include "dovetail/dovetail.hpp"
#include "dovetail/geometry/occt_model.hpp"
#include "dovetail/io/gather.hpp"
#include "dovetail/mesh/eigen.hpp"
#include "dovetail/mesher/tetgen.hpp"

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace dovetail;

/// A solution of which everything is known: u = sin(k . x), so that f = |k|^2 u.
struct wave {
  Eigen::Vector3d k;
  double operator()(const Eigen::Vector3d& x) const { return std::sin(k.dot(x)); }
  double source(const Eigen::Vector3d& x) const { return k.squaredNorm() * (*this)(x); }
};

/// Volume, centre, and the gradients of the four hat functions of a tetrahedron.
struct linear_element {
  double volume;
  Eigen::Vector3d centre;
  Eigen::Matrix<double, 3, 4> gradients;
};

linear_element element_of(const simplicial_mesh<3>& mesh, Eigen::Index e) {
  const auto points = as_matrix(mesh.points);     // n x 3, in place
  const auto elements = as_matrix(mesh.elements); // m x 4, in place
  Eigen::Matrix4d corners;                        // a row per vertex: 1, x, y, z
  for (int i = 0; i < 4; ++i)
    corners.row(i) << 1, points.row(elements(e, i));
  return {corners.determinant() / 6, corners.colwise().mean().tail<3>(), corners.inverse().bottomRows<3>()};
}

std::vector<bool> points_on_boundary(const io::gathered_mesh<3>& whole) {
  std::vector<bool> given(whole.mesh.points.size(), false);
  for (std::size_t s = 0; s < whole.sides.size(); ++s)
    if (whole.side_elements[s][1] == no_id) // the domain ends there; other sides lie between materials
      for (const auto v : whole.sides[s])
        given[static_cast<std::size_t>(v)] = true;
  return given;
}

Eigen::VectorXd solve(const io::gathered_mesh<3>& whole, const wave& exact) {
  const auto given = points_on_boundary(whole);
  const auto points = as_matrix(whole.mesh.points);
  const auto elements = as_matrix(whole.mesh.elements);
  auto stiffness = zero_matrix(whole.mesh); // with the entries that linear elements need
  Eigen::VectorXd load = Eigen::VectorXd::Zero(points.rows());
  for (Eigen::Index e = 0; e < elements.rows(); ++e) {
    const auto element = element_of(whole.mesh, e);
    for (int i = 0; i < 4; ++i) {
      const auto row = elements(e, i);
      if (given[static_cast<std::size_t>(row)])
        continue;
      load[row] += element.volume / 4 * exact.source(element.centre);
      for (int j = 0; j < 4; ++j) {
        const auto column = elements(e, j);
        const double entry = element.volume * element.gradients.col(i).dot(element.gradients.col(j));
        if (given[static_cast<std::size_t>(column)])
          load[row] -= entry * exact(points.row(column));
        else
          stiffness.coeffRef(row, column) += entry;
      }
    }
  }
  for (Eigen::Index p = 0; p < points.rows(); ++p)
    if (given[static_cast<std::size_t>(p)]) {
      stiffness.coeffRef(p, p) = 1;
      load[p] = exact(points.row(p));
    }
  Eigen::ConjugateGradient<decltype(stiffness), Eigen::Lower | Eigen::Upper> solver(stiffness);
  return solver.solve(load);
}

/// Root of the mean square of the error at the centres of the elements.
double l2_error(const simplicial_mesh<3>& mesh, const Eigen::VectorXd& u, const wave& exact) {
  const auto elements = as_matrix(mesh.elements);
  double squares = 0, domain = 0;
  for (Eigen::Index e = 0; e < elements.rows(); ++e) {
    const auto element = element_of(mesh, e);
    const double mean = (u[elements(e, 0)] + u[elements(e, 1)] + u[elements(e, 2)] + u[elements(e, 3)]) / 4;
    squares += element.volume * std::pow(mean - exact(element.centre), 2);
    domain += element.volume;
  }
  return std::sqrt(squares / domain);
}

} // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::puts("usage: 07_poisson FILE [SIZE]");
    return 2;
  }
  const auto model = read_occt_model(argv[1]).model;
  const double diagonal = model.bounds().diagonal();
  const wave exact{Eigen::Vector3d(4, 5, 3) / diagonal};
  const double size = argc > 2 ? std::atof(argv[2]) : diagonal / 16;
  double before = 0;
  for (const double h : {size, size / 2}) {
    const auto result = generate<3>(model, uniform_size(h), parameters<>{}.with_mesher(mesher::tetgen{}));
    const auto whole = io::gather(result.mesh);
    const double error = l2_error(whole.mesh, solve(whole, exact), exact);
    std::printf("size %.3g: %zu tetrahedra, error %.3g\n", h, whole.mesh.elements.size(), error);
    if (before > 0)
      std::printf("the error falls by a factor of %.2f\n", before / error);
    before = error;
  }
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
