/// @file
/// Triangulated shapes for tests, and writers of the formats that the library reads.
#pragma once

#include "dovetail/models/discrete/soup.hpp"
#include "files/scratch_folder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::testing {

inline void append(triangle_soup& to, const triangle_soup& from, bool turned = false) {
  const auto first = static_cast<local_id>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (auto t : from.triangles) {
    for (auto& v : t)
      v += first;
    if (turned)
      std::swap(t[1], t[2]);
    to.triangles.push_back(t);
    to.groups.push_back(no_id);
  }
}

/// A box of n x n squares per side, outwards.
inline triangle_soup box_soup(vec3 a, vec3 b, int n = 1) {
  triangle_soup soup;
  const auto side = [&](int axis, bool upper) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto first = static_cast<local_id>(soup.points.size());
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        vec3 p;
        p[axis] = upper ? b[axis] : a[axis];
        p[u] = a[u] + (b[u] - a[u]) * i / n;
        p[v] = a[v] + (b[v] - a[v]) * j / n;
        soup.points.push_back(p);
      }
    const auto id = [&](int i, int j) { return first + j * (n + 1) + i; };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (auto t : {simplex<2>{id(i, j), id(i + 1, j), id(i + 1, j + 1)},
                       simplex<2>{id(i, j), id(i + 1, j + 1), id(i, j + 1)}}) {
          if (!upper)
            std::swap(t[1], t[2]);
          soup.triangles.push_back(t);
          soup.groups.push_back(no_id);
        }
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true})
      side(axis, upper);
  return soup;
}

/// The square [-1, 1]^2 of n x n squares, lifted to `height(x, y)`.
template <class Height>
triangle_soup sheet_soup(int n, Height&& height) {
  triangle_soup soup;
  const auto id = [&](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = 2.0 * i / n - 1, y = 2.0 * j / n - 1;
      soup.points.push_back({x, y, height(x, y)});
      if (i < n && j < n) {
        soup.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
        soup.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
      }
    }
  soup.groups.assign(soup.triangles.size(), no_id);
  return soup;
}

/// A box of n x n squares per side without the side of largest z.
inline triangle_soup open_box_soup(vec3 a, vec3 b, int n) {
  triangle_soup soup = box_soup(a, b, n);
  std::erase_if(soup.triangles, [&](const simplex<2>& t) {
    return std::all_of(t.begin(), t.end(), [&](local_id v) { return soup.points[v].z == b.z; });
  });
  soup.groups.resize(soup.triangles.size());
  return soup;
}

/// A cube of n x n squares per side blown up to a sphere.
inline triangle_soup sphere_soup(vec3 center, double radius, int n) {
  triangle_soup soup = box_soup({-1, -1, -1}, {1, 1, 1}, n);
  for (vec3& p : soup.points) {
    const vec3 t{std::tan(p.x * std::numbers::pi / 4), std::tan(p.y * std::numbers::pi / 4),
                 std::tan(p.z * std::numbers::pi / 4)};
    p = center + radius * normalized(t);
  }
  return soup;
}

/// A closed torus around z, n points along the tube's circle, m around the axis.
inline triangle_soup torus_soup(double large, double small, int m, int n) {
  triangle_soup soup;
  const double turn = 2 * std::numbers::pi;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double r = large + small * std::cos(turn * j / n);
      soup.points.push_back(
          {r * std::cos(turn * i / m), r * std::sin(turn * i / m), small * std::sin(turn * j / n)});
    }
  const auto id = [&](int i, int j) { return (i % m) * n + j % n; };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j)
      for (const auto& t : {simplex<2>{id(i, j), id(i + 1, j), id(i + 1, j + 1)},
                            simplex<2>{id(i, j), id(i + 1, j + 1), id(i, j + 1)}}) {
        soup.triangles.push_back(t);
        soup.groups.push_back(no_id);
      }
  return soup;
}

inline void write_binary_stl(const std::filesystem::path& file, const triangle_soup& soup) {
  std::ofstream out(file, std::ios::binary);
  std::string header = "solid by name only";
  header.resize(80, ' ');
  out << header;
  const auto count = static_cast<std::uint32_t>(soup.triangles.size());
  out.write(reinterpret_cast<const char*>(&count), 4);
  for (const auto& t : soup.triangles) {
    std::array<float, 12> numbers{};
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        numbers[3 + 3 * k + static_cast<std::size_t>(axis)] = static_cast<float>(soup.points[t[k]][axis]);
    out.write(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
    out.write("\0\0", 2);
  }
}

inline void write_text_stl(const std::filesystem::path& file, const triangle_soup& soup) {
  std::ofstream out(file);
  out.precision(9);
  out << "solid part\n";
  for (const auto& t : soup.triangles) {
    out << " facet normal 0 0 0\n  outer loop\n";
    for (const auto v : t) {
      const vec3 p = soup.points[v];
      out << "   vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
    out << "  endloop\n endfacet\n";
  }
  out << "endsolid part\n";
}

} // namespace dovetail::testing
