/// @file
/// What every improver has to respect, as checks on a mesh before and after; and meshes that are hard to
/// improve.
#pragma once

#include "dovetail/improver/concepts.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/validity.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

namespace improver_checks {

using dovetail::local_id;
using dovetail::simplex;
using dovetail::vec3;
using mesh_type = dovetail::simplicial_mesh<3>;
using frozen_type = dovetail::frozen_entities<3>;
/// A triangle by its coordinates, so that renumbering of points does not matter.
using placed_side = std::array<std::array<double, 3>, 3>;

inline placed_side place(const mesh_type& mesh, const std::array<local_id, 3>& v) {
  placed_side side;
  for (std::size_t k = 0; k < 3; ++k) {
    const vec3 p = mesh.points[v[k]];
    side[k] = {p.x, p.y, p.z};
  }
  std::sort(side.begin(), side.end());
  return side;
}

/// The sides with one element, and those between two tags.
inline std::set<placed_side> outer_and_material_sides(const mesh_type& mesh) {
  std::map<std::array<local_id, 3>, std::vector<std::size_t>> at;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const auto& local : dovetail::numbering::sides<3>) {
      std::array<local_id, 3> v{};
      for (std::size_t k = 0; k < 3; ++k)
        v[k] = mesh.elements[e][local[k]];
      std::sort(v.begin(), v.end());
      at[v].push_back(e);
    }
  std::set<placed_side> result;
  for (const auto& [side, elements] : at)
    if (elements.size() == 1 || (!mesh.tags.empty() && mesh.tags[elements[0]] != mesh.tags[elements[1]]))
      result.insert(place(mesh, side));
  return result;
}

inline std::set<placed_side> all_sides(const mesh_type& mesh) {
  std::set<placed_side> result;
  for (const auto& element : mesh.elements)
    for (const auto& local : dovetail::numbering::sides<3>)
      result.insert(place(mesh, {element[local[0]], element[local[1]], element[local[2]]}));
  return result;
}

inline std::map<local_id, double> volume_per_tag(const mesh_type& mesh) {
  std::map<local_id, double> volumes;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto p = dovetail::corners(std::span(mesh.points), mesh.elements[e]);
    volumes[mesh.tags.empty() ? 0 : mesh.tags[e]] += dovetail::signed_volume(p[0], p[1], p[2], p[3]);
  }
  return volumes;
}

inline std::size_t inverted_count(const mesh_type& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.elements.begin(), mesh.elements.end(), [&](const simplex<3>& element) {
        const auto p = dovetail::corners(std::span(mesh.points), element);
        return dovetail::orient3d(p[0], p[1], p[2], p[3]) <= 0;
      }));
}

/// What must be the same before and after: the boundary, material interfaces, frozen sides and points, the
/// volume of each tag; and there may not be more inverted elements. A valid mesh stays valid.
inline void check_kept(const mesh_type& mesh, const mesh_type& result, const frozen_type& frozen = {}) {
  const std::size_t inverted_before = inverted_count(mesh);
  CHECK(inverted_count(result) <= inverted_before);
  if (inverted_before == 0) {
    const auto validity = dovetail::check_validity(result);
    CHECK_MESSAGE(validity.valid(), validity.text());
  }
  CHECK(outer_and_material_sides(result) == outer_and_material_sides(mesh));
  if (!frozen.sides.empty()) {
    const auto sides = all_sides(result);
    for (const auto& side : frozen.sides)
      CHECK(sides.count(place(mesh, side)) == 1);
  }
  CHECK(result.points.size() >= static_cast<std::size_t>(frozen.points));
  for (std::size_t v = 0; v < static_cast<std::size_t>(frozen.points); ++v)
    CHECK(result.points[v] == mesh.points[v]);
  const auto before = volume_per_tag(mesh), after = volume_per_tag(result);
  CHECK(before.size() == after.size());
  for (const auto& [tag, volume] : before)
    CHECK(after.at(tag) == doctest::Approx(volume).epsilon(1e-9));
}

/// Improves a copy of `mesh` and checks all that the concept promises; returns the result. A mesh that is
/// valid must stay valid and its worst element may not get worse; one with inverted elements must not get
/// more.
template <class Improver>
mesh_type check_contract(const Improver& improver, const mesh_type& mesh, const frozen_type& frozen = {},
                         const dovetail::any_sizing& size = {}) {
  mesh_type result = mesh;
  improver(result, frozen, size);
  check_kept(mesh, result, frozen);
  if (inverted_count(mesh) == 0)
    CHECK(dovetail::measure_quality(result).min_dihedral_deg >=
          dovetail::measure_quality(mesh).min_dihedral_deg - 1e-3);
  return result;
}

/// Points of the boundary must keep number and place even when the caller does not list them.
inline void check_boundary_points(const mesh_type& before, const mesh_type& after) {
  const auto at_boundary = [](const mesh_type& mesh) {
    std::map<std::array<local_id, 3>, int> count;
    for (const auto& element : mesh.elements)
      for (const auto& local : dovetail::numbering::sides<3>) {
        std::array<local_id, 3> v{};
        for (std::size_t k = 0; k < 3; ++k)
          v[k] = element[local[k]];
        std::sort(v.begin(), v.end());
        ++count[v];
      }
    std::set<local_id> vertices;
    for (const auto& [side, n] : count)
      if (n == 1)
        vertices.insert(side.begin(), side.end());
    return vertices;
  };
  const auto vertices = at_boundary(before);
  CHECK(at_boundary(after) == vertices);
  for (const local_id v : vertices)
    CHECK(after.points[v] == before.points[v]);
}

/// Jittered cubes squeezed along one axis and sheared: needles, caps and slivers everywhere.
inline mesh_type squeezed_cubes(int n, std::uint64_t seed, double squeeze) {
  auto mesh = dovetail_test::jittered_cubes(n, 0.15, seed);
  for (auto& p : mesh.points)
    p = {p.x, p.y, squeeze * p.z + 0.3 * p.x};
  return mesh;
}

/// Cubes with straight boundary whose inner points are thrown about by up to `jitter` cell widths per axis.
inline mesh_type tangled_cubes(int n, std::uint64_t seed, double jitter) {
  auto mesh = dovetail_test::jittered_cubes(n, 0);
  dovetail_test::random_numbers random(seed);
  const auto is_inside = [](double x) { return x > 1e-9 && x < 1 - 1e-9; };
  for (auto& p : mesh.points)
    if (is_inside(p.x) && is_inside(p.y) && is_inside(p.z))
      p += jitter / n * vec3{random.signed_unit(), random.signed_unit(), random.signed_unit()};
  return mesh;
}

} // namespace improver_checks
