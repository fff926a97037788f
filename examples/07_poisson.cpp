/// Linear finite elements from a CAD file with Eigen: -laplace(u) = f with u given on the boundary, solved at
/// two sizes. The error of a method of second order falls to a quarter. Usage: 07_poisson FILE [SIZE]
#include "dovetail/dovetail.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/solver/gather.hpp"
#include "linear_elements.hpp"

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
  double before = 0, elements_before = 0;
  for (const double h : {size, size / 2}) {
    const auto result = generate<3>(model, uniform_size(h), parameters<>{});
    const auto whole = io::gather(result.mesh);
    const double error = l2_error(whole.mesh, solve(whole.mesh, exact), exact);
    std::printf("size %.3g: %zu tetrahedra, error %.3g\n", h, whole.mesh.elements.size(), error);
    // The size that a mesh really has goes with the number of its elements to the power of -1/3.
    const auto elements = static_cast<double>(whole.mesh.elements.size());
    if (before > 0)
      std::printf("the error goes with the size to the power of %.2f\n",
                  3 * std::log(before / error) / std::log(elements / elements_before));
    before = error;
    elements_before = elements;
  }
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
