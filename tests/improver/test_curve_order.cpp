/// @file
/// The order along a Hilbert curve, and numbers given back after it.
#include "dovetail/improver/tetrahedra/mesh_exchange.hpp"
#include "improver_checks.hpp"

#include <doctest/doctest.h>

using namespace dovetail::improvement;
using namespace improver_checks;

namespace {

/// Elements by the places of their points, in any order.
std::multiset<std::array<std::array<double, 3>, 4>> placed_elements(const mesh_type& mesh) {
  std::multiset<std::array<std::array<double, 3>, 4>> result;
  for (const auto& element : mesh.elements) {
    std::array<std::array<double, 3>, 4> placed{};
    for (std::size_t k = 0; k < 4; ++k) {
      const vec3 p = mesh.points[element[k]];
      placed[k] = {p.x, p.y, p.z};
    }
    result.insert(placed);
  }
  return result;
}

} // namespace

TEST_CASE("ordering renames points and moves elements, and changes nothing else") {
  auto mesh = dovetail_test::shuffled(dovetail_test::jittered_cubes(5, 0.2, 3), 8);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    mesh.tags.push_back(mesh.elements[e][0]); // a tag that can be found again
  auto ordered = mesh;
  const auto before = order_along_curve(ordered);
  REQUIRE(before.size() == mesh.points.size());
  for (std::size_t v = 0; v < before.size(); ++v)
    CHECK(ordered.points[v] == mesh.points[before[v]]);
  CHECK(placed_elements(ordered) == placed_elements(mesh));
  local_id last_first = 0;
  for (std::size_t e = 0; e < ordered.elements.size(); ++e) {
    const auto& v = ordered.elements[e];
    CHECK(before[v[0]] == ordered.tags[e]);
    const local_id first = *std::min_element(v.begin(), v.end());
    CHECK(first >= last_first);
    last_first = first;
  }
}

TEST_CASE("neighbours get close numbers") {
  // In a cube of n^3 points a random order parts the ends of an edge by n^3 / 3 on average.
  const int n = 16;
  auto mesh = dovetail_test::shuffled(dovetail_test::jittered_cubes(n, 0.1, 1), 5);
  const auto mean_gap = [](const mesh_type& m) {
    double sum = 0;
    for (const auto& v : m.elements)
      for (const auto& edge : dovetail::numbering::ridges<3>)
        sum += std::abs(v[edge[0]] - v[edge[1]]);
    return sum / (6.0 * static_cast<double>(m.elements.size()));
  };
  REQUIRE(mean_gap(mesh) > 1000);
  order_along_curve(mesh);
  CHECK(mean_gap(mesh) < 300);
}

TEST_CASE("what is taken in any layout is given back with its fixed points in place") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const auto mesh = dovetail_test::shuffled(dovetail_test::jittered_cubes(3, 0.1, seed), seed);
    frozen_type frozen;
    frozen.points = static_cast<local_id>(seed % 7);
    frozen.sides.push_back({mesh.elements[9][2], mesh.elements[9][0], mesh.elements[9][1]});
    for (const layout order : {layout::as_given, layout::along_curve}) {
      auto taken = mesh;
      auto complex = take_mesh(taken, frozen, order);
      CHECK(complex.is_consistent());
      int inner_fixed = 0;
      for (local_id e = 0; e < complex.element_slots(); ++e)
        for (int side = 0; side < 4; ++side)
          inner_fixed += complex.is_fixed(e, side) && complex.across(e, side) != dovetail::no_id;
      CHECK(inner_fixed <= 2);
      mesh_type back;
      give_back(complex, back);
      CHECK(back.points.size() == mesh.points.size());
      CHECK(placed_elements(back) == placed_elements(mesh));
      check_boundary_points(mesh, back);
      for (std::size_t v = 0; v < static_cast<std::size_t>(frozen.points); ++v)
        CHECK(back.points[v] == mesh.points[v]);
    }
  }
}

TEST_CASE("points without elements keep their numbers; errors name the caller's points") {
  mesh_type mesh{{{5, 5, 5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}, {0, 0, 1}}, {{1, 2, 3, 5}}, {}};
  const auto before = mesh;
  auto complex = take_mesh(mesh, {}, layout::along_curve);
  give_back(complex, mesh);
  CHECK(mesh.points == before.points);
  CHECK(mesh.elements == before.elements);

  auto doubled = before;
  doubled.points.push_back({2, 2, 2});
  doubled.points.push_back({2, 2, 3});
  doubled.elements.push_back({2, 3, 5, 6});
  doubled.elements.push_back({2, 3, 5, 7});
  CHECK_THROWS_WITH_AS(take_mesh(doubled, {}, layout::along_curve),
                       "more than two elements meet at the side (2, 3, 5)", dovetail::mesh_error);
  auto frozen = before;
  CHECK_THROWS_WITH_AS(take_mesh(frozen, {.points = 0, .sides = {{5, 4, 1}}}, layout::along_curve),
                       "frozen side (1, 4, 5) is not a side of the mesh", dovetail::mesh_error);
}
