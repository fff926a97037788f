/// @file
/// Small random meshes that are as poor as meshes get: points near a plane, a line or a sphere joined as in a
/// Delaunay triangulation, elements split near their corners, pieces stacked on others; squeezed, and some of
/// them with flat or inverted elements.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "improver_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

namespace random_meshes {

using namespace improver_checks;
using dovetail_test::random_numbers;

/// A tetrahedron into which points are inserted, by brute force.
class growing_mesh {
public:
  mesh_type mesh{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 2, 1, 3}}, {}};

  growing_mesh() {
    if (!is_positive(mesh.elements[0]))
      std::swap(mesh.elements[0][2], mesh.elements[0][3]);
  }

  /// Joins `p` to the outline of a cavity as large as the Delaunay criterion makes it and the eye of `p`
  /// allows. Points outside the mesh are left out.
  void insert(vec3 p) {
    std::vector<bool> in_cavity(mesh.elements.size());
    for (std::size_t e = 0; e < in_cavity.size(); ++e)
      in_cavity[e] = is_in_sphere(mesh.elements[e], p) || contains(mesh.elements[e], p);
    while (remove_hidden(in_cavity, p)) {
    }
    const auto sides = outline(in_cavity);
    if (!sides.empty() && !swallows_a_point(in_cavity, sides))
      join(in_cavity, sides, p);
  }
  /// Splits element `e` into four at the place with these weights.
  void split(std::size_t e, const std::array<double, 4>& weights) {
    const simplex<3> v = mesh.elements[e];
    vec3 p{};
    for (std::size_t k = 0; k < 4; ++k)
      p += weights[k] * at(v[k]);
    std::vector<bool> in_cavity(mesh.elements.size(), false);
    in_cavity[e] = true;
    for (const auto& side : sides_of(v))
      if (!sees(p, side))
        return;
    join(in_cavity, outline(in_cavity), p);
  }
  /// Puts an element of this height on the mesh's outline.
  void stack(std::size_t nth_side, double height) {
    const auto sides = outline(std::vector<bool>(mesh.elements.size(), true));
    const auto& s = sides[nth_side % sides.size()];
    const vec3 normal = cross(at(s[1]) - at(s[0]), at(s[2]) - at(s[0]));
    const vec3 apex = (at(s[0]) + at(s[1]) + at(s[2])) / 3 + height / norm(normal) * normal;
    mesh.points.push_back(apex);
    const simplex<3> added{static_cast<local_id>(mesh.points.size() - 1), s[0], s[2], s[1]};
    if (is_positive(added))
      mesh.elements.push_back(added);
    else
      mesh.points.pop_back();
  }

private:
  using side_type = std::array<local_id, 3>;

  vec3 at(local_id v) const { return mesh.points[v]; }
  bool is_positive(const simplex<3>& v) const {
    return dovetail::orient3d(at(v[0]), at(v[1]), at(v[2]), at(v[3])) > 0;
  }
  static std::array<side_type, 4> sides_of(const simplex<3>& v) {
    std::array<side_type, 4> sides{};
    for (std::size_t s = 0; s < 4; ++s)
      for (std::size_t k = 0; k < 3; ++k)
        sides[s][k] = v[dovetail::numbering::sides<3>[s][k]];
    return sides;
  }
  /// `p` is strictly on the inner side of an outward side.
  bool sees(vec3 p, const side_type& s) const {
    return dovetail::orient3d(p, at(s[0]), at(s[1]), at(s[2])) > 0;
  }
  bool contains(const simplex<3>& v, vec3 p) const {
    const auto sides = sides_of(v);
    return std::all_of(sides.begin(), sides.end(), [&](const side_type& s) { return sees(p, s); });
  }
  /// Up to rounding, which may make other cavities than Delaunay's.
  bool is_in_sphere(const simplex<3>& v, vec3 p) const {
    const vec3 a = at(v[1]) - at(v[0]), b = at(v[2]) - at(v[0]), c = at(v[3]) - at(v[0]);
    const double volume = 2 * dot(a, cross(b, c));
    const vec3 center =
        (norm_squared(a) * cross(b, c) + norm_squared(b) * cross(c, a) + norm_squared(c) * cross(a, b)) /
        volume;
    return norm_squared(p - at(v[0]) - center) < norm_squared(center);
  }
  /// Sides with one element of the set, outwards, and that element.
  std::map<side_type, std::pair<side_type, std::size_t>>
  outline_with_owners(const std::vector<bool>& set) const {
    std::map<side_type, std::pair<side_type, std::size_t>> open;
    for (std::size_t e = 0; e < set.size(); ++e)
      for (const auto& side : set[e] ? sides_of(mesh.elements[e]) : std::array<side_type, 4>{}) {
        if (!set[e])
          break;
        auto key = side;
        std::sort(key.begin(), key.end());
        if (!open.erase(key))
          open[key] = {side, e};
      }
    return open;
  }
  std::vector<side_type> outline(const std::vector<bool>& set) const {
    std::vector<side_type> sides;
    for (const auto& [key, side] : outline_with_owners(set))
      sides.push_back(side.first);
    return sides;
  }
  /// Takes elements out whose side on the outline `p` does not see; false when there are none.
  bool remove_hidden(std::vector<bool>& set, vec3 p) const {
    bool removed = false;
    for (const auto& [key, side] : outline_with_owners(set))
      if (!sees(p, side.first)) {
        set[side.second] = false;
        removed = true;
      }
    return removed;
  }
  bool swallows_a_point(const std::vector<bool>& set, const std::vector<side_type>& sides) const {
    for (std::size_t e = 0; e < set.size(); ++e)
      for (const local_id v : mesh.elements[e])
        if (set[e] && std::none_of(sides.begin(), sides.end(), [v](const side_type& side) {
              return std::find(side.begin(), side.end(), v) != side.end();
            }))
          return true;
    return false;
  }
  void join(const std::vector<bool>& cavity, const std::vector<side_type>& sides, vec3 p) {
    std::vector<simplex<3>> elements;
    for (std::size_t e = 0; e < cavity.size(); ++e)
      if (!cavity[e])
        elements.push_back(mesh.elements[e]);
    const auto apex = static_cast<local_id>(mesh.points.size());
    for (const auto& s : sides)
      elements.push_back({apex, s[0], s[1], s[2]});
    mesh.points.push_back(p);
    mesh.elements = std::move(elements);
  }
};

inline vec3 any_vector(random_numbers& random) {
  return {random.signed_unit(), random.signed_unit(), random.signed_unit()};
}

/// Where points are drawn: all over, near a plane (caps, slivers), near a line (needles), on a sphere
/// (slivers).
inline vec3 any_point(random_numbers& random, std::uint64_t kind) {
  const vec3 p = any_vector(random);
  const double thin = std::pow(10.0, -5 * random.unit());
  switch (kind % 4) {
  case 1:
    return {0.5 * p.x, 0.5 * p.y, 0.5 * thin * p.z};
  case 2:
    return {0.5 * p.x, 0.5 * thin * p.y, 0.5 * thin * p.z};
  case 3:
    return 0.4 / norm(p) * p;
  default:
    return 0.6 * p;
  }
}

/// All elements positive; 1 to about 100 of them, mostly 5 to 20.
inline mesh_type valid_mesh(std::uint64_t seed) {
  random_numbers random(seed);
  growing_mesh grown;
  const std::uint64_t kind = seed % 6;
  if (seed % 3 == 0)
    for (std::uint64_t s = 0; s <= seed % 2; ++s)
      grown.stack(random.bits(), std::pow(10.0, -1 - 4 * random.unit()));
  const int changes = 1 + static_cast<int>(random.bits() % (seed % 64 == 7 ? 14 : 3));
  for (int k = 0; k < changes; ++k) {
    if (kind < 4) {
      grown.insert(any_point(random, kind));
      continue;
    }
    std::array<double, 4> weights{};
    double sum = 0;
    for (auto& weight : weights)
      sum += weight = std::pow(10.0, -4 * random.unit());
    for (auto& weight : weights)
      weight /= sum;
    grown.split(random.bits() % grown.mesh.elements.size(), weights);
  }
  return grown.mesh;
}

/// Moves some inner points far, into the plane of a side, or onto another point.
inline void tangle(mesh_type& mesh, random_numbers& random) {
  const auto point_of = [&](local_id v) -> vec3& { return mesh.points[v]; };
  const auto outer = outer_and_material_sides(mesh);
  for (local_id v = 0; v < static_cast<local_id>(mesh.points.size()); ++v) {
    const vec3 p = point_of(v);
    const std::array<double, 3> placed{p.x, p.y, p.z};
    const bool is_outer = std::any_of(outer.begin(), outer.end(), [&](const placed_side& side) {
      return std::find(side.begin(), side.end(), placed) != side.end();
    });
    if (is_outer || random.unit() > 0.3)
      continue;
    const auto& e = mesh.elements[random.bits() % mesh.elements.size()];
    const double kind = random.unit();
    point_of(v) = kind < 0.4   ? p + 0.5 * any_vector(random)
                  : kind < 0.8 ? (point_of(e[0]) + point_of(e[1]) + point_of(e[2])) / 3
                               : point_of(e[0]);
  }
}

/// A mesh, what is frozen of it, and a size (0: none).
struct test_input {
  mesh_type mesh;
  frozen_type frozen;
  double size = 0;
};

inline test_input random_input(std::uint64_t seed) {
  random_numbers random(seed + 77);
  test_input made{valid_mesh(seed), {}, 0};
  auto& mesh = made.mesh;
  if (seed % 5 == 4)
    tangle(mesh, random);
  const vec3 squeeze{1, std::pow(0.1, random.unit()), std::pow(0.1, 2 * random.unit())};
  for (auto& p : mesh.points)
    p = {squeeze.x * p.x, squeeze.y * p.y, squeeze.z * p.z + 0.3 * p.x};
  if (seed % 4 == 1) {
    const vec3 normal = any_vector(random);
    for (const auto& v : mesh.elements) {
      const auto p = dovetail::corners(std::span(mesh.points), v);
      mesh.tags.push_back(dot(normal, p[0] + p[1] + p[2] + p[3]) > 0 ? 7 : 3);
    }
  }
  if (seed % 4 == 2)
    made.frozen.points = static_cast<local_id>(random.bits() % mesh.points.size());
  if (seed % 4 == 3)
    for (const auto& v : mesh.elements)
      if (random.unit() < 0.1)
        made.frozen.sides.push_back({v[1], v[0], v[2]});
  if (seed % 3 == 2)
    made.size = 0.1 + random.unit();
  return made;
}

} // namespace random_meshes
