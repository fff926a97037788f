/// @file
/// Closed boundaries at random that are hard to recover, by families.
#pragma once

#include "dovetail/mesher/checks.hpp"
#include "mesher/boundary_fault.hpp"
#include "mesher/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace random_pieces {

using dovetail::local_id;
using dovetail::simplex;
using dovetail::vec3;
using shapes::surface;

/// Draws the same numbers on every platform, as the distributions of the standard library need not.
class dice {
public:
  explicit dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * 0x1p-32 * static_cast<double>(engine_());
  }
  double power_between(double low, double high) { return std::pow(10.0, between(low, high)); }
  int whole(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
  }
  vec3 vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

private:
  std::mt19937 engine_;
};

inline double unbiased_angle(int i, int n) {
  return 2 * std::numbers::pi * i / n;
}

/// Rings of n points each, joined by triangles and closed by a fan at both ends. `walls`: the fans of the
/// rings between are there too, in both directions.
inline surface tower(const std::vector<std::vector<vec3>>& rings, bool walls = false) {
  surface s;
  const auto n = static_cast<local_id>(rings.front().size());
  for (const auto& ring : rings)
    s.points.insert(s.points.end(), ring.begin(), ring.end());
  const auto levels = static_cast<local_id>(rings.size());
  for (local_id level = 0; level < levels; ++level)
    for (local_id i = 1; i + 1 < n; ++i) {
      const local_id b = level * n;
      if (level == 0 || (walls && level + 1 < levels))
        s.elements.push_back({b, b + i + 1, b + i});
      if (level + 1 == levels || (walls && level > 0))
        s.elements.push_back({b, b + i, b + i + 1});
    }
  for (local_id level = 0; level + 1 < levels; ++level)
    for (local_id i = 0; i < n; ++i) {
      const local_id j = (i + 1) % n, b = level * n;
      s.elements.push_back({b + i, b + j, b + n + i});
      s.elements.push_back({b + j, b + n + j, b + n + i});
    }
  return s;
}

inline std::vector<vec3> ring(int n, double radius, double turn, double z) {
  std::vector<vec3> points;
  for (int i = 0; i < n; ++i)
    points.push_back(
        {radius * std::cos(unbiased_angle(i, n) + turn), radius * std::sin(unbiased_angle(i, n) + turn), z});
  return points;
}

/// Backwards nearly as far as diagonals stay clear of the axis, so that others of the same quadrangles lie
/// outside.
inline double backwards(dice& d, int n) {
  return -d.between(0.05, 0.85) * std::numbers::pi * (1 - 2.0 / n);
}

inline surface twisted_prism(dice& d) {
  const int n = d.whole(3, 20);
  const double height = d.power_between(-1, 1);
  return tower({ring(n, 1, 0, 0), ring(n, 1, d.whole(0, 3) == 0 ? 0.5 : backwards(d, n), height)});
}

inline surface chain_of_prisms(dice& d) {
  const int n = d.whole(3, 8);
  std::vector<std::vector<vec3>> rings;
  double turn = 0, z = 0;
  for (int level = d.whole(3, 8); level > 0; --level) {
    rings.push_back(ring(n, 1, turn, z));
    turn += backwards(d, n);
    z += d.power_between(-0.5, 0.5);
  }
  return tower(rings, d.whole(0, 1) == 0);
}

/// The squares of a plate, with the points inside shifted: flat with different ones on both sides, or bent.
inline surface slab(dice& d) {
  const int nx = d.whole(2, 8), ny = d.whole(2, 8);
  const double thickness = d.power_between(-6, -1), shift = d.between(0, 0.25);
  const bool is_bent = d.whole(0, 1) == 0;
  auto s = shapes::cells(shapes::block({0, 0, 0}, {nx, ny, 1}), {1, 1, 1});
  std::map<std::array<double, 3>, vec3> shifts;
  for (vec3& p : s.points) {
    const auto [by, fresh] = shifts.try_emplace({p.x, p.y, is_bent ? 0 : p.z}, vec3{});
    if (fresh)
      by->second = shift * d.vector();
    if (p.x > 0 && p.x < nx)
      p.x += by->second.x;
    if (p.y > 0 && p.y < ny)
      p.y += by->second.y;
    p.z = thickness * p.z + (is_bent ? 0.2 * p.x * p.x / nx : 0);
  }
  return s;
}

/// A sheet over a rough ground, often much thinner than the ground is rough.
inline surface rough_sheet(dice& d) {
  const double thickness = d.power_between(-3, 0), height = d.between(0, 1.5);
  auto s = shapes::cells(shapes::block({0, 0, 0}, {d.whole(2, 7), d.whole(2, 7), 1}), {1, 1, thickness});
  std::map<std::array<double, 2>, double> ground;
  for (vec3& p : s.points) {
    const auto [place, fresh] = ground.try_emplace({p.x, p.y}, 0.0);
    if (fresh)
      place->second = height * d.between(-1, 1);
    p.z += place->second;
  }
  return s;
}

inline surface needle(dice& d) {
  const int n = d.whole(3, 12), levels = d.whole(2, 5);
  const double length = d.power_between(0, 5);
  std::vector<std::vector<vec3>> rings;
  for (int level = 0; level < levels; ++level)
    rings.push_back(ring(n, 1 - 0.95 * level / (levels - 1), d.between(-0.3, 0.3), length * level / levels));
  return tower(rings);
}

/// A wheel of long thin triangles from one rim to the other.
inline surface lantern(dice& d) {
  const int n = d.whole(10, 60);
  const double height = d.power_between(-2, 2); // drawn first: compilers order arguments differently
  const double turn = d.between(-0.5, 0.5);
  return tower({ring(n, 1, 0, 0), ring(n, 1, turn, height)});
}

/// A box of stretched cells.
inline surface stretched_box(dice& d) {
  return shapes::cells(shapes::block({0, 0, 0}, {d.whole(1, 6), d.whole(1, 6), d.whole(1, 6)}),
                       {d.power_between(-2, 0), d.power_between(-2, 0), d.power_between(-2, 0)});
}

inline void turn_about_axes(surface& s, dice& d) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = d.between(0, 6), c = std::cos(a), sine = std::sin(a);
    for (vec3& p : s.points) {
      double& u = p[static_cast<int>(axis)];
      double& v = p[static_cast<int>((axis + 1) % 3)];
      const double old = u;
      u = c * old - sine * v;
      v = sine * old + c * v;
    }
  }
}

/// Shells one inside the other, every second one a void.
inline surface nested_shells(dice& d) {
  surface s;
  double radius = 1;
  const int count = d.whole(2, 5);
  for (int k = 0; k < count; ++k) {
    auto shell = shapes::sphere(d.whole(0, 2), radius);
    turn_about_axes(shell, d);
    shapes::append(s, shell, k % 2 == 1);
    // A sphere of few triangles has a smaller one inside of it.
    radius *= 0.79 * (1 - d.power_between(-3, -0.5));
  }
  return s;
}

inline surface squeezed_torus(dice& d) {
  const double small = d.between(0.1, 0.6);
  auto s = shapes::torus(d.whole(4, 10), 1, small);
  const double squeeze = d.power_between(-4, 0), shear = d.between(-2, 2);
  turn_about_axes(s, d);
  for (vec3& p : s.points) {
    p.x *= squeeze;
    p.y += shear * p.z;
  }
  return s;
}

inline surface noisy_sphere(dice& d) {
  auto s = shapes::sphere(d.whole(1, 3));
  const double noise = d.between(0, 0.9);
  for (vec3& p : s.points)
    p = (1 - noise * d.between(0, 1)) * p;
  return s;
}

inline void shift_points(surface& s, dice& d, double by) {
  for (vec3& p : s.points)
    p += by * d.vector();
}

/// Cells that touch at sides, edges and vertices.
inline surface touching_cells(dice& d) {
  const double filled = d.between(0.2, 0.8);
  const auto cells = shapes::block(
      {0, 0, 0}, {4, 4, 4}, [&](int x, int y, int z) { return x + y + z == 0 || d.between(0, 1) < filled; });
  auto s = shapes::cells(cells, {1, 1, 1});
  shift_points(s, d, d.between(0, 0.15));
  return s;
}

/// A block of cells, with walls between some of them that are listed in both directions.
inline surface walled_cells(dice& d) {
  const int n = d.whole(2, 4);
  std::map<std::array<int, 3>, int> kind;
  auto s = shapes::cells(shapes::block({0, 0, 0}, {n, n, n},
                                       [&](int x, int y, int z) {
                                         kind[{x, y, z}] = d.whole(0, 2);
                                         return true;
                                       }),
                         {1, 1, 1});
  std::map<std::array<double, 3>, local_id> at;
  for (std::size_t v = 0; v < s.points.size(); ++v)
    at[{s.points[v].x, s.points[v].y, s.points[v].z}] = static_cast<local_id>(v);
  const auto vertex = [&](std::array<int, 3> c) {
    const vec3 p{double(c[0]), double(c[1]), double(c[2])};
    const auto [place, fresh] = at.try_emplace({p.x, p.y, p.z}, static_cast<local_id>(s.points.size()));
    if (fresh)
      s.points.push_back(p);
    return place->second;
  };
  for (const auto& [cell, k] : kind)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto next = cell;
      ++next[axis];
      if (next[axis] == n || kind[next] == k)
        continue;
      std::array<local_id, 4> q{};
      for (std::size_t i = 0; i < 4; ++i) {
        auto c = next;
        c[(axis + 1) % 3] += i == 1 || i == 2;
        c[(axis + 2) % 3] += i >= 2;
        q[i] = vertex(c);
      }
      for (const simplex<2>& t : {simplex<2>{q[0], q[1], q[2]}, simplex<2>{q[0], q[2], q[3]}}) {
        s.elements.push_back(t);
        s.elements.push_back({t[0], t[2], t[1]});
      }
    }
  shift_points(s, d, d.between(0, 0.15));
  return s;
}

/// A ball or a box with walls that end inside of it, each a triangle in a box of its own, so that none
/// crosses another; some come as near as a thousandth of their length.
inline surface ending_walls(dice& d) {
  const int n = d.whole(1, 3), kept = d.whole(1, 10);
  const double fill = 1 - d.power_between(-3, -0.3);
  auto s = d.whole(0, 1) == 0 ? shapes::sphere(1, 2) : shapes::cube(4, 2, {-1, -1, -1});
  const double step = 1.2 / n;
  for (int box = 0; box < n * n * n; ++box) {
    if (d.whole(1, 10) > kept)
      continue;
    const vec3 middle =
        step * vec3{box % n + 0.5, box / n % n + 0.5, box / n / n + 0.5} - 0.6 * vec3{1, 1, 1};
    const auto v = static_cast<local_id>(s.points.size());
    for (int k = 0; k < 3; ++k)
      s.points.push_back(middle + 0.5 * step * fill * d.vector());
    s.elements.push_back({v, v + 1, v + 2});
    s.elements.push_back({v, v + 2, v + 1});
  }
  return s;
}

struct family {
  std::string name;
  surface (*make)(dice&);
};
inline const std::vector<family>& families() {
  static const std::vector<family> all{{"twisted prisms", twisted_prism},
                                       {"chains of prisms", chain_of_prisms},
                                       {"thin slabs", slab},
                                       {"rough sheets", rough_sheet},
                                       {"needles", needle},
                                       {"lanterns", lantern},
                                       {"stretched boxes", stretched_box},
                                       {"nested shells", nested_shells},
                                       {"squeezed tori", squeezed_torus},
                                       {"noisy spheres", noisy_sphere},
                                       {"touching cells", touching_cells},
                                       {"walled cells", walled_cells},
                                       {"ending walls", ending_walls}};
  return all;
}

struct piece {
  surface boundary;
  double size; ///< of the elements to be
};
/// The same piece for the same numbers. Every second one is turned in space, so that planes are not those of
/// the axes, and every second one has points inside.
inline piece make(std::size_t family, unsigned seed) {
  dice d(seed * 64 + static_cast<unsigned>(family));
  piece p{families()[family].make(d), 0};
  if (d.whole(0, 1) == 0)
    turn_about_axes(p.boundary, d);
  const double edge = shapes::mean_edge(p.boundary);
  const double volume = dovetail::enclosed_volume(p.boundary.points, p.boundary.elements);
  constexpr double most_cells = 3000; // of the size, that the test may be short
  p.size =
      d.whole(0, 1) == 0 ? 100 * edge : std::max(d.between(0.4, 1) * edge, std::cbrt(volume / most_cells));
  return p;
}

/// A boundary that passes through itself or touches itself, so that no elements fill it: one with points at
/// each other's places, or with one pushed to the other side, or two that cross.
inline surface make_crossing(unsigned seed) {
  dice d(seed);
  const int kind = d.whole(0, 4);
  auto s = d.whole(0, 1) == 0 ? shapes::sphere(d.whole(1, 4)) : shapes::torus(d.whole(4, 20));
  const auto any = [&] {
    return static_cast<std::size_t>(d.whole(0, static_cast<int>(s.points.size()) - 1));
  };
  if (kind == 0) {
    for (int k = d.whole(1, 20); k > 0; --k)
      std::swap(s.points[any()], s.points[any()]);
  } else if (kind == 1) {
    vec3& p = s.points[any()];
    p = -1.3 * p + 0.01 * d.vector();
  } else if (kind == 2) {
    auto other = s;
    turn_about_axes(other, d);
    for (vec3& p : other.points)
      p += d.between(0, 1) * vec3{1, 0.1, 0.2};
    shapes::append(s, other);
  } else if (kind == 3) {
    for (vec3& p : s.points) // nothing is where it was
      p = d.vector();
  } else {
    for (vec3& p : s.points)
      p = {1e-5 * p.x + 1e-4 * d.between(-1, 1), p.y, p.z};
  }
  return s;
}

} // namespace random_pieces
