/// The improver alone, on arrays of one's own.
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/quality.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

/// What a program might hold: a cube of n^3 cells of six tetrahedra each, its inner points disturbed.
struct my_mesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 4>> tetrahedra;
};

my_mesh disturbed_cube(int n) {
  my_mesh mesh;
  const auto shift = [n](int i, double seed) { // none on the boundary
    return i == 0 || i == n ? 0.0 : 0.25 * std::sin(1e3 * seed);
  };
  for (int z = 0; z <= n; ++z)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        const double seed = 1 + x + 17.0 * y + 291.0 * z;
        mesh.points.push_back({x + shift(x, seed), y + shift(y, 2 * seed), z + shift(z, 3 * seed)});
      }
  const auto corner = [n](int x, int y, int z) { return (z * (n + 1) + y) * (n + 1) + x; };
  // Each way along the axes from one corner of a cell to the opposite one passes the corners of one
  // tetrahedron.
  const int ways[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (int way = 0; way < 6; ++way) {
          int at[3] = {x, y, z};
          std::array<int, 4> tetrahedron{corner(x, y, z), 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[ways[way][step]];
            tetrahedron[step + 1] = corner(at[0], at[1], at[2]);
          }
          if (way >= 3) // an odd permutation of the axes
            std::swap(tetrahedron[2], tetrahedron[3]);
          mesh.tetrahedra.push_back(tetrahedron);
        }
  return mesh;
}

} // namespace

int main() {
  const my_mesh mine = disturbed_cube(12);

  // for the readme
  dovetail::simplicial_mesh<3> mesh;
  for (const auto& [x, y, z] : mine.points)
    mesh.points.push_back({x, y, z});
  mesh.elements.assign(mine.tetrahedra.begin(), mine.tetrahedra.end());
  const auto before = dovetail::measure_quality(mesh).min_dihedral_deg;
  const auto report = dovetail::improvement::native::fine()(mesh); // the boundary stays as it is
  // end

  const auto after = dovetail::measure_quality(mesh).min_dihedral_deg;
  std::printf("%zu tetrahedra in %.2f s: smallest dihedral angle %.1f degrees, before %.1f\n",
              mesh.elements.size(), report.seconds, after, before);
  return after > before ? 0 : 1;
}
