/// @file
/// Random meshes for tests and benchmarks: jittered grids, split into simplices.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace dovetail_test {

/// A reproducible generator of uniform numbers (splitmix64); the same on every platform.
class random_numbers {
public:
  explicit random_numbers(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// In [0, 1).
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// In [-1, 1).
  double signed_unit() { return 2 * unit() - 1; }

private:
  std::uint64_t state_;
};

/// The coordinate of line `index` of n cells on [0, 1], moved by at most `jitter` cell widths inside.
inline double jittered(int index, int n, double jitter, random_numbers& random) {
  const bool inside = index > 0 && index < n;
  const double h = 1.0 / n;
  return h * (index + (inside ? jitter * random.signed_unit() : 0.0));
}

/// A unit cube of n^3 cells, each cut into the six tetrahedra of Kuhn's subdivision; inner points moved by at
/// most `jitter` cell widths per axis. Positively oriented for jitter up to 0.15.
inline dovetail::simplicial_mesh<3> jittered_cubes(int n, double jitter = 0.15, std::uint64_t seed = 1) {
  dovetail::simplicial_mesh<3> mesh;
  random_numbers random(seed);
  const int m = n + 1;
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) {
        const auto at = [&](int index) { return jittered(index, n, jitter, random); };
        const double x = at(i);
        const double y = at(j);
        mesh.points.push_back({x, y, at(k)});
      }
  const auto id = [&](int i, int j, int k) { return static_cast<dovetail::local_id>((k * m + j) * m + i); };
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (int t = 0; t < 6; ++t) {
          std::array<int, 3> corner{i, j, k};
          dovetail::simplex<3> tet{id(i, j, k), 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step) {
            ++corner[orders[t][step]];
            tet[step + 1] = id(corner[0], corner[1], corner[2]);
          }
          if (t >= 3) // odd orders are left-handed
            std::swap(tet[2], tet[3]);
          mesh.elements.push_back(tet);
        }
  return mesh;
}

/// An n x n grid of squares over the unit square, on the graph of a smooth function of height `bump`, each
/// cut along a random diagonal; counter-clockwise seen from above.
inline dovetail::simplicial_mesh<2> jittered_squares(int n, double jitter = 0.2, std::uint64_t seed = 1,
                                                     double bump = 0.1) {
  dovetail::simplicial_mesh<2> mesh;
  random_numbers random(seed);
  const int m = n + 1;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) {
      const auto at = [&](int index) { return jittered(index, n, jitter, random); };
      const double x = at(i);
      const double y = at(j);
      mesh.points.push_back({x, y, bump * std::sin(4 * x) * std::cos(3 * y)});
    }
  const auto id = [&](int i, int j) { return static_cast<dovetail::local_id>(j * m + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = id(i, j);
      const auto b = id(i + 1, j);
      const auto c = id(i + 1, j + 1);
      const auto d = id(i, j + 1);
      if (random.unit() < 0.5) {
        mesh.elements.push_back({a, b, c});
        mesh.elements.push_back({a, c, d});
      } else {
        mesh.elements.push_back({a, b, d});
        mesh.elements.push_back({b, c, d});
      }
    }
  return mesh;
}

/// The same mesh with points and elements renumbered at random.
template <int D>
dovetail::simplicial_mesh<D> shuffled(const dovetail::simplicial_mesh<D>& mesh, std::uint64_t seed) {
  random_numbers random(seed);
  const auto permutation = [&](std::size_t count) {
    std::vector<dovetail::local_id> order(count);
    for (std::size_t i = 0; i < count; ++i)
      order[i] = static_cast<dovetail::local_id>(i);
    for (std::size_t i = count; i > 1; --i)
      std::swap(order[i - 1], order[random.bits() % i]);
    return order;
  };
  const auto new_point = permutation(mesh.points.size());
  const auto new_element = permutation(mesh.elements.size());
  dovetail::simplicial_mesh<D> result = mesh;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    result.points[new_point[v]] = mesh.points[v];
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto to = static_cast<std::size_t>(new_element[e]);
    for (std::size_t k = 0; k < mesh.elements[e].size(); ++k)
      result.elements[to][k] = new_point[mesh.elements[e][k]];
    if (!mesh.tags.empty())
      result.tags[to] = mesh.tags[e];
  }
  return result;
}

} // namespace dovetail_test
