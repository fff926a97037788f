#include "support/adjacency.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <vector>

using namespace dovetail;

namespace {

/// Sides found the slow way: sorted vertices -> elements.
template <int D>
std::map<simplex<D - 1>, std::vector<local_id>> sides_by_map(const simplicial_mesh<D>& mesh) {
  std::map<simplex<D - 1>, std::vector<local_id>> found;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const auto& local : numbering::sides<D>)
      found[sorted_vertices(detail::pick(mesh.elements[e], local))].push_back(static_cast<local_id>(e));
  return found;
}

template <int D>
void check_sides(const simplicial_mesh<D>& mesh) {
  const side_table<D> sides = build_sides(mesh);
  const auto expected = sides_by_map(mesh);
  REQUIRE(sides.size() == expected.size());
  std::size_t s = 0;
  for (const auto& [vertices, elements] : expected) {
    REQUIRE(sorted_vertices(sides.vertices[s]) == vertices);
    REQUIRE(sides.all_elements(static_cast<local_id>(s)) == elements);
    REQUIRE(sides.is_interior(static_cast<local_id>(s)) == (elements.size() == 2));
    REQUIRE(sides.is_boundary(static_cast<local_id>(s)) == (elements.size() == 1));
    ++s;
  }
  const auto neighbours = element_neighbours(sides);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (std::size_t i = 0; i <= D; ++i) {
      const auto side = sides.of_element[e][i];
      const auto vertices = detail::pick(mesh.elements[e], numbering::sides<D>[i]);
      REQUIRE(sorted_vertices(sides.vertices[side]) == sorted_vertices(vertices));
      const auto& both = expected.at(sorted_vertices(vertices));
      const local_id self = static_cast<local_id>(e);
      const local_id other = both.size() == 2 ? (both[0] == self ? both[1] : both[0]) : no_id;
      REQUIRE(neighbours[e][i] == other);
    }
}

/// Every dihedral is in exactly one fan, consecutive dihedrals share an interior side, and fans are maximal.
template <int D>
void check_ridges(const simplicial_mesh<D>& mesh) {
  const auto adj = dovetail_test::build_adjacency(mesh);
  std::set<std::pair<local_id, int>> seen;
  for (std::size_t r = 0; r < adj.ridges.size(); ++r)
    for (std::size_t f = adj.ridges.fan_begins[r]; f < adj.ridges.fan_begins[r + 1]; ++f) {
      const auto codes = adj.ridges.fan(f);
      REQUIRE(!codes.empty());
      const auto side = [&](std::uint32_t code, std::size_t end) {
        const dihedral w = ridge_table<D>::decode(code);
        return adj.sides.of_element[w.element][w.sides[end]];
      };
      for (std::size_t k = 0; k < codes.size(); ++k) {
        const dihedral w = ridge_table<D>::decode(codes[k]);
        REQUIRE(seen.insert({w.element, w.ridge}).second);
        REQUIRE(adj.ridges.of_element[w.element][w.ridge] == static_cast<local_id>(r));
        if (k + 1 < codes.size()) {
          REQUIRE(side(codes[k], 1) == side(codes[k + 1], 0));
          REQUIRE(adj.sides.is_interior(side(codes[k], 1)));
        }
      }
      if (adj.ridges.closed[f]) {
        REQUIRE(side(codes.back(), 1) == side(codes.front(), 0));
        REQUIRE(adj.sides.is_interior(side(codes.front(), 0)));
      } else {
        REQUIRE(!adj.sides.is_interior(side(codes.back(), 1)));
        REQUIRE(!adj.sides.is_interior(side(codes.front(), 0)));
      }
    }
  REQUIRE(seen.size() == mesh.elements.size() * ridge_table<D>::per_element);
}

/// The ridges at wanted points are those of all whose points are wanted, with the same fans.
template <int D>
void check_ridges_at(const simplicial_mesh<D>& mesh, std::uint64_t seed) {
  const auto adj = dovetail_test::build_adjacency(mesh);
  std::mt19937_64 random(seed);
  std::vector<std::uint8_t> is_wanted(mesh.points.size());
  for (auto& wanted : is_wanted)
    wanted = random() % 3 > 0 ? 1 : 0;
  const auto some = build_ridges_at(mesh, adj.sides, is_wanted);
  std::size_t found = 0;
  for (std::size_t r = 0; r < adj.ridges.size(); ++r) {
    const auto& vertices = adj.ridges.vertices[r];
    const bool wanted = std::all_of(vertices.begin(), vertices.end(),
                                    [&](local_id v) { return is_wanted[static_cast<std::size_t>(v)] != 0; });
    if (wanted) {
      REQUIRE(some.vertices[found] == vertices);
      const std::size_t fans = adj.ridges.fan_begins[r + 1] - adj.ridges.fan_begins[r];
      REQUIRE(some.fan_begins[found + 1] - some.fan_begins[found] == fans);
      for (std::size_t f = 0; f < fans; ++f) {
        const auto expected = adj.ridges.fan(adj.ridges.fan_begins[r] + f);
        const auto fan = some.fan(some.fan_begins[found] + f);
        REQUIRE(std::equal(fan.begin(), fan.end(), expected.begin(), expected.end()));
        REQUIRE(some.closed[some.fan_begins[found] + f] == adj.ridges.closed[adj.ridges.fan_begins[r] + f]);
      }
    }
    for (std::size_t f = adj.ridges.fan_begins[r]; f < adj.ridges.fan_begins[r + 1]; ++f)
      for (const std::uint32_t code : adj.ridges.fan(f)) {
        const dihedral w = ridge_table<D>::decode(code);
        REQUIRE(some.of_element[w.element][w.ridge] == (wanted ? static_cast<local_id>(found) : no_id));
      }
    found += wanted ? 1 : 0;
  }
  REQUIRE(some.size() == found);
  REQUIRE(found > 0);
  REQUIRE(found < adj.ridges.size());
}

} // namespace

TEST_CASE("sides and neighbours agree with a map on random meshes") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    check_sides(dovetail_test::shuffled(dovetail_test::jittered_cubes(4, 0.15, seed), seed));
    check_sides(dovetail_test::shuffled(dovetail_test::jittered_squares(9, 0.2, seed), seed));
  }
}

TEST_CASE("fans cover all dihedrals in order around their ridges") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    check_ridges(dovetail_test::shuffled(dovetail_test::jittered_cubes(4, 0.15, seed), seed));
    check_ridges(dovetail_test::shuffled(dovetail_test::jittered_squares(9, 0.2, seed), seed));
  }
}

TEST_CASE("ridges at wanted points are the same as among all") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    check_ridges_at(dovetail_test::shuffled(dovetail_test::jittered_cubes(4, 0.15, seed), seed), seed);
    check_ridges_at(dovetail_test::shuffled(dovetail_test::jittered_squares(9, 0.2, seed), seed), seed);
  }
}

TEST_CASE("counts of a cube of tetrahedra satisfy Euler's formula") {
  const auto mesh = dovetail_test::jittered_cubes(5);
  const auto adj = dovetail_test::build_adjacency(mesh);
  const auto euler = static_cast<long>(mesh.points.size()) - static_cast<long>(adj.ridges.size()) +
                     static_cast<long>(adj.sides.size()) - static_cast<long>(mesh.elements.size());
  CHECK(euler == 1);
  CHECK(adj.fan_count() == adj.ridges.size());
}

TEST_CASE("sides of the first element point outwards") {
  const auto mesh = dovetail_test::jittered_cubes(3);
  const auto sides = build_sides(mesh);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto& v = sides.vertices[s];
    const auto& tet = mesh.elements[sides.elements[s][0]];
    vec3 center{};
    for (const local_id p : tet)
      center += 0.25 * mesh.points[p];
    const auto at = [&](std::size_t k) { return mesh.points[v[k]]; };
    CHECK(signed_volume(at(0), at(1), at(2), center) < 0);
  }
}

TEST_CASE("three sheets meeting at a line give a non-manifold side and open fans") {
  simplicial_mesh<2> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  mesh.elements = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  check_sides(mesh);
  check_ridges(mesh);
  const auto adj = dovetail_test::build_adjacency(mesh);
  CHECK(adj.sides.is_non_manifold(0));
  CHECK_FALSE(adj.sides.is_interior(0));
  CHECK(adj.sides.all_elements(0) == std::vector<local_id>{0, 1, 2});
  CHECK(adj.ridges.fan_begins[1] == 3); // three fans of one dihedral at point 0
}

TEST_CASE("two tetrahedra that touch in an edge only have two fans there") {
  simplicial_mesh<3> mesh;
  mesh.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.elements = {{0, 2, 3, 1}, {0, 4, 5, 1}};
  check_ridges(mesh);
  const auto adj = dovetail_test::build_adjacency(mesh);
  CHECK(adj.ridges.fan_begins[1] == 2);
}

TEST_CASE("a closed surface has only closed fans, whatever its orientation") {
  // A Moebius strip of five quads is not orientable; its fans still have to be chains.
  simplicial_mesh<2> strip;
  for (int i = 0; i < 10; ++i)
    strip.points.push_back({double(i), double(i % 2), 0});
  for (local_id i = 0; i < 5; ++i) {
    const local_id a = 2 * i;
    const local_id b = 2 * i + 1;
    const local_id c = i == 4 ? 1 : a + 2;
    const local_id d = i == 4 ? 0 : b + 2;
    strip.elements.push_back({a, c, b});
    strip.elements.push_back({b, c, d});
  }
  check_sides(strip);
  check_ridges(strip);

  simplicial_mesh<2> tetrahedron;
  tetrahedron.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& side : numbering::sides<3>)
    tetrahedron.elements.push_back({local_id(side[0]), local_id(side[1]), local_id(side[2])});
  check_ridges(tetrahedron);
  for (const bool closed : dovetail_test::build_adjacency(tetrahedron).ridges.closed)
    CHECK(closed);
}

TEST_CASE("an element that refers to a missing point is refused by name") {
  simplicial_mesh<2> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}};
  mesh.elements = {{0, 1, 7}};
  CHECK_THROWS_WITH_AS(build_sides(mesh), doctest::Contains("element 0 refers to point 7"), mesh_error);
}
