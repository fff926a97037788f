/// @file
/// Each operation against brute force or first principles.
#include "dovetail/improver/tetrahedra/edge_contraction.hpp"
#include "dovetail/improver/tetrahedra/edge_removal.hpp"
#include "dovetail/improver/tetrahedra/face_removal.hpp"
#include "dovetail/improver/tetrahedra/mesh_exchange.hpp"
#include "dovetail/improver/tetrahedra/surface_limits.hpp"
#include "dovetail/improver/tetrahedra/vertex_insertion.hpp"
#include "dovetail/improver/tetrahedra/vertex_smoothing.hpp"
#include "improver_checks.hpp"

#include <doctest/doctest.h>

#include <numbers>

using namespace dovetail::improvement;
using namespace improver_checks;

namespace {

using measure = minimum_dihedral;

/// n elements around the edge from (0, 0, -1) to (0, 0, 1), with a jittered ring; all positive.
mesh_type ring_mesh(int n, std::uint64_t seed) {
  dovetail_test::random_numbers random(seed);
  mesh_type mesh;
  mesh.points = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.3 * random.signed_unit()) / n;
    const double radius = 1 + 0.3 * random.signed_unit();
    mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.4 * random.signed_unit()});
    mesh.elements.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
  }
  return mesh;
}

void evaluate(tet_complex& mesh) {
  for (local_id e = 0; e < mesh.element_slots(); ++e) {
    const auto& v = mesh.vertices(e);
    mesh.set_value(e, static_cast<float>(measure_of<measure>(mesh.point(v[0]), mesh.point(v[1]),
                                                             mesh.point(v[2]), mesh.point(v[3]))));
  }
  mesh.set_target(static_cast<float>(measure::from_angle(35)));
}

/// The worst value of the best triangulation of the ring, by trying all of them.
double best_by_force(const mesh_type& mesh, const std::vector<local_id>& polygon) {
  if (polygon.size() < 3)
    return 2;
  const auto at = [&](local_id v) { return mesh.points[v]; };
  // The triangle on the polygon's closing edge has some third vertex; split there.
  double best = -2;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const vec3 i = at(polygon.front()), m = at(polygon[k]), j = at(polygon.back());
    const double here = std::min(measure_of<measure>(at(0), i, m, j), measure_of<measure>(at(1), i, j, m));
    const std::vector<local_id> left(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    const std::vector<local_id> right(polygon.begin() + static_cast<std::ptrdiff_t>(k), polygon.end());
    best = std::max(best, std::min({here, best_by_force(mesh, left), best_by_force(mesh, right)}));
  }
  return best;
}

int edge_of(const tet_complex& mesh, local_id e, local_id a, local_id b) {
  for (int edge = 0; edge < 6; ++edge) {
    const auto& corners = edge_corners[edge];
    const local_id p = mesh.vertex(e, corners[0]), q = mesh.vertex(e, corners[1]);
    if ((p == a && q == b) || (p == b && q == a))
      return edge;
  }
  return -1;
}

/// Triangles of a fan about ring point 0, each between the apexes n and n + 1: elements 2 i and 2 i + 1.
mesh_type sandwich(int n, std::uint64_t seed) {
  dovetail_test::random_numbers random(seed);
  mesh_type mesh;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.25 * random.signed_unit()) / n;
    mesh.points.push_back({std::cos(angle), std::sin(angle), 0.02 * random.signed_unit()});
  }
  const double height = 0.1 + 0.6 * random.unit();
  mesh.points.push_back({0.3 * random.signed_unit(), 0.3 * random.signed_unit(), -height});
  mesh.points.push_back({0.3 * random.signed_unit(), 0.3 * random.signed_unit(), height});
  for (int i = 1; i + 1 < n; ++i) {
    mesh.elements.push_back({n, 0, i, i + 1});
    mesh.elements.push_back({n + 1, 0, i + 1, i});
  }
  return mesh;
}

/// Whether the removal of some run of the fan's triangles that contains `start` makes the worst element
/// better: the gain of the best one, else 0.
double best_removal_by_force(const mesh_type& mesh, int n, int start) {
  const auto at = [&](local_id v) { return mesh.points[v]; };
  const auto value_of = [&](local_id x, local_id y) {
    return measure_of<measure>(at(n), at(n + 1), at(x), at(y));
  };
  double best = 0;
  for (int from = 1; from <= start; ++from)
    for (int to = start; to + 1 < n; ++to) {
      double before = 2, after = std::min(value_of(0, from), value_of(to + 1, 0));
      for (int i = from; i <= to; ++i) {
        after = std::min(after, value_of(i, i + 1));
        for (const int e : {2 * (i - 1), 2 * (i - 1) + 1}) {
          const auto& v = mesh.elements[e];
          before = std::min(before, measure_of<measure>(at(v[0]), at(v[1]), at(v[2]), at(v[3])));
        }
      }
      best = std::max(best, after - before);
    }
  return best;
}

} // namespace

TEST_CASE("edge removal finds the best triangulation of the ring") {
  int improved = 0;
  edge_removal<measure> removal;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const int n = 3 + static_cast<int>(seed % 8);
    CAPTURE(seed);
    const auto plain = ring_mesh(n, seed);
    auto input = plain;
    auto mesh = take_mesh(input, {});
    evaluate(mesh);
    edge_shell shell;
    REQUIRE(collect_shell(mesh, 0, edge_of(mesh, 0, 0, 1), shell));
    REQUIRE(shell.ring.size == n);
    local_change change;
    std::vector<local_id> ring;
    for (int i = 0; i < n; ++i)
      ring.push_back(2 + i);
    const double expected = best_by_force(plain, ring);
    const bool found = removal.find(mesh, shell, -1.5F, change);
    REQUIRE(found == (expected > -1.5));
    CHECK(change.worst == doctest::Approx(expected).epsilon(1e-5));
    CHECK(change.fresh.size == 2 * (n - 2));
    // With the old elements as the bar it is found exactly when it helps.
    const float bar = worst_value(mesh, shell.elements.view());
    const bool helps = removal.find(mesh, shell, bar, change);
    if (std::abs(expected - static_cast<double>(bar)) > 1e-5)
      CHECK(helps == (expected > static_cast<double>(bar)));
    if (!helps)
      continue;
    ++improved;
    std::array<local_id, max_cavity> ids{};
    mesh.replace(change.old.view(), change.fresh.view(), change.values.view(),
                 {ids.data(), static_cast<std::size_t>(change.fresh.size)});
    CHECK(mesh.is_consistent());
    CHECK(mesh.element_count() == static_cast<std::size_t>(change.fresh.size));
    mesh_type after;
    give_back(mesh, after);
    CHECK(outer_and_material_sides(after) == outer_and_material_sides(plain));
    CHECK(volume_per_tag(after).at(0) == doctest::Approx(volume_per_tag(plain).at(0)));
  }
  CHECK(improved > 50);
}

TEST_CASE("the removal of a side is the 2-3 flip") {
  mesh_type mesh;
  mesh.points = {{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {0, 0, -0.2}, {0, 0, 0.2}};
  mesh.elements = {{3, 0, 1, 2}, {4, 0, 2, 1}};
  REQUIRE(inverted_count(mesh) == 0);
  const auto plain = mesh;
  auto complex = take_mesh(mesh, {});
  evaluate(complex);
  face_removal<measure> removal;
  local_change change;
  int found = 0;
  for (int side = 0; side < 4; ++side)
    found += removal.find(complex, 0, side, change) ? 1 : 0;
  REQUIRE(found == 1);
  CHECK(change.fresh.size == 3);
  std::array<local_id, max_cavity> ids{};
  complex.replace(change.old.view(), change.fresh.view(), change.values.view(),
                  {ids.data(), static_cast<std::size_t>(change.fresh.size)});
  CHECK(complex.is_consistent());
  mesh_type after;
  give_back(complex, after);
  CHECK(inverted_count(after) == 0);
  CHECK(outer_and_material_sides(after) == outer_and_material_sides(plain));
}

TEST_CASE("several sides between two apexes are removed together") {
  // A flat square of two triangles between apexes a and b: the union of the four elements is a bipyramid.
  mesh_type mesh;
  mesh.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0.05, 0.02, -0.15}, {0.05, 0.02, 0.15}};
  mesh.elements = {{4, 0, 1, 2}, {4, 0, 2, 3}, {5, 0, 2, 1}, {5, 0, 3, 2}};
  REQUIRE(inverted_count(mesh) == 0);
  auto complex = take_mesh(mesh, {});
  evaluate(complex);
  face_removal<measure> removal;
  local_change change;
  bool found = false;
  for (int side = 0; side < 4 && !found; ++side)
    found = removal.find(complex, 0, side, change);
  REQUIRE(found);
  CHECK(change.old.size == 4);
  CHECK(change.fresh.size == 4);
}

TEST_CASE("sides between two apexes are removed only where that helps, and mostly where it can") {
  int possible = 0, found = 0, several = 0;
  face_removal<measure> removal;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const int n = 4 + static_cast<int>(seed % 4);
    auto input = sandwich(n, seed);
    if (inverted_count(input) > 0)
      continue;
    const auto plain = input;
    auto mesh = take_mesh(input, {});
    evaluate(mesh);
    for (int start = 1; start + 1 < n; ++start) {
      const local_id e = 2 * (start - 1);
      const double gain = best_removal_by_force(plain, n, start);
      local_change change;
      const bool helps = removal.find(mesh, e, 0, change);
      possible += gain > 1e-5;
      found += helps;
      several += helps && change.old.size > 2;
      if (!helps)
        continue;
      CHECK(gain > -1e-5);
      CHECK(static_cast<double>(change.worst - worst_value(mesh, change.old.view())) <= gain + 1e-5);
      CHECK(change.worst > worst_value(mesh, change.old.view()));
      CHECK(change.fresh.size == change.old.size / 2 + 2); // one per edge of the outline
    }
  }
  MESSAGE(possible << " could be removed, " << found << " were, " << several << " of them several at once");
  CHECK(several > 50);
  CHECK(found <= possible + 2);
  CHECK(found * 10 >= possible * 8);
}

TEST_CASE("a fixed edge has no shell, a fixed side is not removed") {
  auto input = ring_mesh(6, 1);
  auto mesh = take_mesh(input, {.points = 0, .sides = {{0, 1, 4}}});
  evaluate(mesh);
  edge_shell shell;
  CHECK_FALSE(collect_shell(mesh, 0, edge_of(mesh, 0, 0, 1), shell));
  face_removal<measure> removal;
  local_change change;
  for (local_id e = 0; e < mesh.element_slots(); ++e)
    for (int side = 0; side < 4; ++side)
      if (mesh.is_fixed(e, side))
        CHECK_FALSE(removal.find(mesh, e, side, change));
}

TEST_CASE("values of a batch agree with those of single elements") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    dovetail_test::random_numbers random(seed);
    const auto any = [&] {
      return vec3{5 + random.signed_unit(), random.signed_unit(), random.signed_unit()};
    };
    const vec3 apex = any();
    star_batch<measure> batch;
    batch.start(any(), 1.5);
    std::vector<std::array<vec3, 3>> sides;
    for (int i = 0; i < 21; ++i)
      sides.push_back({any(), any(), any()});
    for (const auto& s : sides)
      REQUIRE(batch.add(s[0], s[1], s[2]));
    batch.finish();
    star_batch<measure>::values values{};
    const float worst = batch.measure(batch.to_local(apex), values);
    double expected_worst = 2;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const double expected = measure_of<measure>(apex, sides[i][0], sides[i][1], sides[i][2]);
      if (std::abs(expected) > 1e-2)
        CHECK(static_cast<double>(values[i]) == doctest::Approx(expected).epsilon(1e-2));
      expected_worst = std::min(expected_worst, expected);
    }
    CHECK(static_cast<double>(worst) == doctest::Approx(expected_worst).epsilon(1e-2));
  }
}

TEST_CASE("smoothing finds the centre of a regular star") {
  // The icosahedron's centre is the best apex by symmetry.
  const double g = std::numbers::phi;
  std::vector<vec3> p{{0, 1, g},  {0, -1, g},  {0, 1, -g}, {0, -1, -g}, {1, g, 0},  {-1, g, 0},
                      {1, -g, 0}, {-1, -g, 0}, {g, 0, 1},  {-g, 0, 1},  {g, 0, -1}, {-g, 0, -1}};
  mesh_type mesh;
  mesh.points = p;
  mesh.points.push_back({0.5, -0.4, 0.3});
  for (local_id i = 0; i < 12; ++i)
    for (local_id j = i + 1; j < 12; ++j)
      for (local_id k = j + 1; k < 12; ++k) {
        const auto near = [&](local_id a, local_id b) { return distance(p[a], p[b]) < 2.1; };
        if (!near(i, j) || !near(j, k) || !near(k, i))
          continue;
        const bool outwards = dovetail::signed_volume({0, 0, 0}, p[i], p[j], p[k]) > 0;
        mesh.elements.push_back(outwards ? simplex<3>{12, i, j, k} : simplex<3>{12, i, k, j});
      }
  REQUIRE(mesh.elements.size() == 20);
  auto complex = take_mesh(mesh, {});
  evaluate(complex);
  vertex_smoothing<measure> smoothing;
  for (int k = 0; k < 20; ++k)
    smoothing.improve(complex, 12, {.iterations = 20, .enough = 2, .radius = 0.25F}, {});
  CHECK(norm(complex.point(12)) < 0.02);
}

TEST_CASE("an inserted vertex replaces a sliver between fixed vertices") {
  auto mesh = squeezed_cubes(5, 7, 0.6);
  const auto plain = mesh;
  auto complex = take_mesh(mesh, {});
  evaluate(complex);
  vertex_insertion<measure> insertion;
  int inserted = 0;
  for (local_id e = 0; e < 300; ++e) {
    if (!complex.is_alive(e))
      continue;
    const auto v = complex.vertices(e);
    const vec3 center =
        0.25 * (complex.point(v[0]) + complex.point(v[1]) + complex.point(v[2]) + complex.point(v[3]));
    insertion_limits limits;
    limits.search.enough = 0.4F;
    inserted += insertion.improve(complex, {&e, 1}, center, limits) ? 1 : 0;
    REQUIRE(complex.is_consistent());
  }
  CHECK(inserted > 0);
  mesh_type after;
  give_back(complex, after);
  const auto validity = dovetail::check_validity(after);
  CHECK_MESSAGE(validity.valid(), validity.text());
  CHECK(outer_and_material_sides(after) == outer_and_material_sides(plain));
}

TEST_CASE("contraction removes a vertex only when that helps") {
  const auto plain = dovetail_test::jittered_cubes(5, 0.14, 9);
  auto mesh = dovetail_test::shuffled(plain, 4);
  const std::size_t points = mesh.points.size();
  auto complex = take_mesh(mesh, {});
  evaluate(complex);
  edge_contraction<measure> contraction;
  std::size_t removed = 0;
  for (local_id e = 0; e < complex.element_slots(); ++e)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if (i != j && complex.is_alive(e) && complex.is_free(complex.vertex(e, i)))
          removed += contraction.improve(complex, complex.vertex(e, i), complex.vertex(e, j), {}) ? 1 : 0;
  CHECK(complex.is_consistent());
  mesh_type after;
  give_back(complex, after);
  CHECK(after.points.size() == points - removed);
  const auto validity = dovetail::check_validity(after);
  CHECK_MESSAGE(validity.valid(), validity.text());
}

TEST_CASE("sharp fixed triangles and dihedrals limit the elements they touch") {
  // A dihedral of 30 degrees along the z axis; the far points are not limited by it.
  mesh_type mesh;
  mesh.points = {
      {0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {std::cos(0.5236), std::sin(0.5236), 0.5}, {1.5, 0.5, 0.5}};
  mesh.elements = {{0, 1, 2, 3}};
  if (inverted_count(mesh) > 0)
    std::swap(mesh.elements[0][2], mesh.elements[0][3]);
  auto sharp = mesh;
  const auto complex = take_mesh(sharp, {});
  CHECK(surface_limits(complex).limits(complex.vertices(0)));
  mesh_type regular{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2, 3}}, {}};
  if (inverted_count(regular) > 0)
    std::swap(regular.elements[0][2], regular.elements[0][3]);
  const auto blunt = take_mesh(regular, {});
  CHECK_FALSE(surface_limits(blunt).limits(blunt.vertices(0)));
}
