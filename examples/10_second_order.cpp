/// Second-order elements: nodes in the middle of edges, on the model, and what they are worth.
/// Usage: 10_second_order
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/second_order.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

using namespace dovetail;

// part volume
/// The determinant of the derivatives of an element's map, at barycentric coordinates.
double jacobian(const std::array<vec3, 10>& nodes, const std::array<double, 4>& at) {
  std::array<vec3, 4> by{};
  for (std::size_t i = 0; i < 4; ++i)
    by[i] = (4 * at[i] - 1) * nodes[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = numbering::edges<3>[e]; // the corners of the edge that node 4 + e is on
    by[a] += 4 * at[b] * nodes[4 + e];
    by[b] += 4 * at[a] * nodes[4 + e];
  }
  return dot(cross(by[1] - by[0], by[2] - by[0]), by[3] - by[0]);
}

double volume(const io::second_order_mesh<3>& mesh) {
  double sum = 0;
  for (const auto& element : mesh.elements) {
    std::array<vec3, 10> nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      nodes[k] = mesh.points[element[k]];
    sum -= 4.0 / 30 * jacobian(nodes, {0.25, 0.25, 0.25, 0.25}); // exact up to degree 3, which this is
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<double, 4> at{1.0 / 6, 1.0 / 6, 1.0 / 6, 1.0 / 6};
      at[i] = 0.5;
      sum += 3.0 / 40 * jacobian(nodes, at);
    }
  }
  return sum;
}
// end

double volume(const simplicial_mesh<3>& mesh) {
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.elements) {
    const auto at = [&](local_id v) { return mesh.points[v]; };
    sum += signed_volume(at(a), at(b), at(c), at(d));
  }
  return sum;
}

} // namespace

int main() try {
  const double exact = 4.0 / 3 * std::numbers::pi;
  std::puts("    size  elements   error of linear   of quadratic elements");
  std::array<double, 2> last{};
  // part mesh
  const implicit_model ball(implicit::sphere{}, {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}});
  for (const double size : {0.4, 0.2}) {
    const auto made = generate<3>(ball, uniform_size(size), parameters<>{});
    const auto linear = io::gather(made.mesh);
    const auto quadratic = io::second_order(linear, ball);
    last = {exact - volume(linear.mesh), std::abs(exact - volume(quadratic))};
    std::printf("%8.2f %9zu %17.5f %23.6f\n", size, linear.mesh.elements.size(), last[0], last[1]);
  }
  // end
  return last[1] < 0.01 * last[0] ? 0 : 1;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
