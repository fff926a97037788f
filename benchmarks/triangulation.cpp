/// Tetrahedra per second of `delaunay<3>` on points at random in a cube, or of a lattice of cubes or of
/// body-centred ones.
/// Usage: triangulation [number of points (default 1 million)] [random|cubic|centred]
#include "dovetail/core/report.hpp"
#include "dovetail/triangulation/delaunay.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string_view>
#include <vector>

namespace {

using dovetail::vec3;

std::vector<vec3> random_points(std::size_t count) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit;
  std::vector<vec3> points(count);
  for (vec3& p : points)
    for (int k = 0; k < 3; ++k)
      p[k] = unit(engine);
  return points;
}

/// Cells of width 0.1 with a point in each of `places` (fractions of a cell).
std::vector<vec3> lattice(std::size_t count, const std::vector<double>& places) {
  const auto cells = static_cast<int>(std::cbrt(static_cast<double>(count / places.size())));
  std::vector<vec3> points;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k)
        for (const double s : places)
          points.push_back(0.1 * vec3{i + s, j + s, k + s});
  return points;
}

} // namespace

int main(int argc, char** argv) {
  const auto count = static_cast<std::size_t>(argc > 1 ? std::atof(argv[1]) : 1e6);
  const std::string_view kind = argc > 2 ? argv[2] : "random";
  const auto points = kind == "random"  ? random_points(count)
                      : kind == "cubic" ? lattice(count, {0.0})
                                        : lattice(count, {0.0, 0.5});
  const dovetail::stopwatch clock;
  const auto made = dovetail::delaunay<3>(points);
  const double seconds = clock.seconds();
  const auto millions = static_cast<double>(made.elements.size()) * 1e-6;
  std::printf("%zu points, %.2f M tetrahedra in %.2f s: %.2f M per second\n", points.size(), millions,
              seconds, millions / seconds);
}
