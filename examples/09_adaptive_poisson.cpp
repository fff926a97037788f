/// Solve, estimate, adapt: linear finite elements on a body with an edge that points inwards, where the
/// solution has unbounded gradients. Meshes adapted to an estimate of the error against uniform ones.
/// Usage: 09_adaptive_poisson [LOOPS]
#include "dovetail/dovetail.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/solver/adapt.hpp"
#include "dovetail/solver/gather.hpp"
#include "linear_elements.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

namespace {

using namespace dovetail;

/// Three quarters of a square, one high; the z axis is the edge that points inwards.
discrete_model l_shaped_body() {
  std::vector<vec3> points;
  for (const double z : {0.0, 1.0})
    for (const vec2 p : {vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}})
      points.push_back({p.x, p.y, z});
  std::vector<simplex<2>> triangles;
  for (local_id i = 0; i < 8; ++i) {
    const local_id next = (i + 1) % 8;
    if (i > 0 && next > 0) {
      triangles.push_back({0, next, i});         // floor
      triangles.push_back({8, 8 + i, 8 + next}); // roof
    }
    triangles.push_back({i, next, 8 + next}); // walls
    triangles.push_back({i, 8 + next, 8 + i});
  }
  return {points, triangles};
}

/// u = r^(2/3) sin(2/3 angle), which solves -laplace(u) = 0: its gradient is infinite at the inner edge.
struct edge_singularity {
  double operator()(const Eigen::Vector3d& x) const {
    return std::pow(std::hypot(x[0], x[1]), 2.0 / 3) * std::sin(2.0 / 3 * angle(x));
  }
  double source(const Eigen::Vector3d&) const { return 0; }
  Eigen::Vector3d gradient(const Eigen::Vector3d& x) const {
    const double steep = 2.0 / 3 * std::pow(std::hypot(x[0], x[1]), -1.0 / 3);
    return {-steep * std::sin(angle(x) / 3), steep * std::cos(angle(x) / 3), 0};
  }
  static double angle(const Eigen::Vector3d& x) { // from the wall y = 0 through the body
    const double a = std::atan2(x[1], x[0]);
    return a < -1e-9 ? a + 2 * std::numbers::pi : a;
  }
};

Eigen::Vector3d gradient_in(const linear_element& element, const simplex<3>& vertices,
                            const Eigen::VectorXd& u) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 4; ++i)
    sum += u[vertices[i]] * element.gradients.col(i);
  return sum;
}

/// Root of the integral of |grad(u - solution)|^2.
double energy_error(const simplicial_mesh<3>& mesh, const Eigen::VectorXd& u, const edge_singularity& exact) {
  const double near = 0.5854101966249685, far = 0.1381966011250105; // weights of a quadrature of second order
  double sum = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto element = element_of(mesh, static_cast<Eigen::Index>(e));
    const auto gradient = gradient_in(element, mesh.elements[e], u);
    for (const local_id corner : mesh.elements[e]) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      for (const local_id v : mesh.elements[e])
        x += (v == corner ? near : far) * as_matrix(mesh.points).row(v).transpose();
      sum += element.volume / 4 * (gradient - exact.gradient(x)).squaredNorm();
    }
  }
  return std::sqrt(sum);
}

/// An estimate of each element's share of the squared error: how far its gradient is from the mean of those
/// around its points (Zienkiewicz and Zhu).
std::vector<double> estimate(const simplicial_mesh<3>& mesh, const Eigen::VectorXd& u) {
  std::vector<Eigen::Vector3d> mean(mesh.points.size(), Eigen::Vector3d::Zero());
  std::vector<double> around(mesh.points.size(), 0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto element = element_of(mesh, static_cast<Eigen::Index>(e));
    for (const local_id v : mesh.elements[e]) {
      mean[v] += element.volume * gradient_in(element, mesh.elements[e], u);
      around[v] += element.volume;
    }
  }
  std::vector<double> shares;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto element = element_of(mesh, static_cast<Eigen::Index>(e));
    double sum = 0;
    for (const local_id corner : mesh.elements[e]) {
      const auto v = static_cast<std::size_t>(corner);
      sum += (mean[v] / around[v] - gradient_in(element, mesh.elements[e], u)).squaredNorm();
    }
    shares.push_back(element.volume / 4 * sum);
  }
  return shares;
}

/// Edge lengths at the points for about `wanted` elements that all have the same share: the error of an
/// element of size h goes with h^2.5.
std::vector<double> new_sizes(const simplicial_mesh<3>& mesh, const std::vector<double>& shares,
                              double wanted) {
  const auto factor = [&](std::size_t e, double share) {
    return std::clamp(std::pow(share / shares[e], 0.2), 0.25, 2.0);
  };
  double low = -60, high = 10; // logarithms of the share
  for (int step = 0; step < 60; ++step) {
    const double share = std::exp((low + high) / 2);
    double elements = 0;
    for (std::size_t e = 0; e < shares.size(); ++e)
      elements += std::pow(factor(e, share), -3);
    (elements > wanted ? low : high) = (low + high) / 2;
  }
  std::vector<double> logarithms(mesh.points.size(), 0), count(mesh.points.size(), 0), sizes;
  for (std::size_t e = 0; e < shares.size(); ++e) {
    double length = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        length += distance(mesh.points[mesh.elements[e][i]], mesh.points[mesh.elements[e][j]]) / 6;
    for (const local_id v : mesh.elements[e]) {
      logarithms[v] += std::log(factor(e, std::exp(high)) * length);
      count[v] += 1;
    }
  }
  for (std::size_t v = 0; v < count.size(); ++v)
    sizes.push_back(std::exp(logarithms[v] / count[v]));
  return sizes;
}

} // namespace

int main(int argc, char** argv) try {
  const int loops = argc > 1 ? std::atoi(argv[1]) : 5;
  const auto model = l_shaped_body();
  const edge_singularity exact;
  const auto policies = parameters<>{}.with_executor(parallel::processes{});

  std::puts("uniform:  elements      error");
  std::size_t uniform_elements = 0;
  double uniform_error = 0;
  for (const double size : {0.24, 0.16, 0.107, 0.071}) {
    const auto mesh = io::gather(generate<3>(model, uniform_size(size), policies).mesh).mesh;
    uniform_elements = mesh.elements.size();
    uniform_error = energy_error(mesh, solve(mesh, exact), exact);
    std::printf("%18zu %10.4f\n", uniform_elements, uniform_error);
  }

  std::puts("adapted:  elements      error");
  // part loop
  adaptable_mesh<3> mesh{io::gather(generate<3>(model, uniform_size(0.24), policies).mesh).mesh};
  for (int loop = 0;; ++loop) {
    const auto u = solve(mesh.mesh, exact);
    const double error = energy_error(mesh.mesh, u, exact);
    std::printf("%18zu %10.4f\n", mesh.mesh.elements.size(), error);
    if (error < uniform_error) {
      std::printf("%.1f times fewer elements than uniform ones, and a smaller error\n",
                  static_cast<double>(uniform_elements) / static_cast<double>(mesh.mesh.elements.size()));
      return 0;
    }
    if (loop == loops)
      break;
    const auto sizes =
        new_sizes(mesh.mesh, estimate(mesh.mesh, u), 1.7 * static_cast<double>(mesh.mesh.elements.size()));
    mesh = whole_mesh(adapt<3>(model, mesh, sizes, policies));
  }
  // end
  std::puts("the uniform meshes have won");
  return 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
