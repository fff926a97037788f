/// @file
/// The native improver on plane meshes of triangles and on discrete surfaces.
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/improver/native.hpp"
#include "surface_checks.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace surface_checks;
using dovetail::improvement::native;

static_assert(dovetail::improver<native, 2>);

namespace {

native preset(std::uint64_t i) {
  return i % 3 == 0 ? native::fast() : i % 3 == 1 ? native::fine() : native::finest();
}

double distance_to(const triangle_mesh& surface, vec3 p) {
  double least = 1e300;
  for (const auto& triangle : surface.elements) {
    const auto c = dovetail::corners(std::span(surface.points), triangle);
    const auto w = dovetail::nearest_on_triangle(c[0], c[1], c[2], p);
    least = std::min(least, distance(w[0] * c[0] + w[1] * c[1] + w[2] * c[2], p));
  }
  return least;
}

/// Each inner point of a plane grid gets a partner next to it: needles at one end, slivers at the other.
triangle_mesh needles_and_slivers(int n, std::uint64_t seed, double apart) {
  auto mesh = dovetail_test::jittered_squares(n, 0.2, seed, 0);
  dovetail_test::random_numbers random(seed);
  const std::size_t count = mesh.elements.size();
  for (std::size_t t = 0; t < count; t += 7) {
    // A point close to a corner, inside the triangle: splits it in three thin ones.
    const auto [a, b, c] = mesh.elements[t];
    const auto p = dovetail::corners(std::span(mesh.points), mesh.elements[t]);
    const double w = apart * random.unit();
    const auto d = static_cast<local_id>(mesh.points.size());
    mesh.points.push_back((1 - w) * p[0] + 0.5 * w * (p[1] + p[2]));
    mesh.elements[t] = {a, b, d};
    mesh.elements.push_back({b, c, d});
    mesh.elements.push_back({c, a, d});
  }
  return mesh;
}

} // namespace

TEST_CASE("plane meshes with holes and two tags keep every promise") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const auto mesh = holed_squares(12 + static_cast<int>(seed % 9), 0.3, seed);
    REQUIRE(turned_over(mesh) == 0);
    auto result = mesh;
    preset(seed)(result);
    check_change(mesh, result);
    CHECK(turned_over(result) == 0);
    const auto before = area_per_tag(mesh), after = area_per_tag(result);
    REQUIRE(after.size() == before.size());
    for (const auto& [tag, area] : before)
      CHECK(after.at(tag) == doctest::Approx(area).epsilon(1e-12));
    for (const vec3& p : result.points)
      CHECK(p.z == 0);
  }
}

TEST_CASE("frozen lines and points inside a mesh stay, bit for bit") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const auto mesh = dovetail_test::jittered_squares(14, 0.3, seed, 0.1);
    frozen_edges frozen;
    frozen.points = 60;
    const auto sides = dovetail::build_sides(mesh);
    for (std::size_t s = seed; s < sides.size(); s += 11)
      frozen.sides.push_back({sides.vertices[s][1], sides.vertices[s][0]});
    auto result = mesh;
    preset(seed)(result, frozen);
    check_change(mesh, result, frozen);
  }
}

TEST_CASE("needles and slivers go") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    CAPTURE(seed);
    const auto mesh = needles_and_slivers(20, seed, 0.02);
    REQUIRE(turned_over(mesh) == 0);
    CHECK(dovetail::measure_quality(mesh).min_dihedrals.below(5) > 50);
    auto result = mesh;
    native::fine()(result);
    check_change(mesh, result);
    CHECK(turned_over(result) == 0);
    const auto quality = dovetail::measure_quality(result);
    CHECK(quality.min_dihedrals.below(24) == 0);
    CHECK(quality.min_dihedrals.below(30) <= 2);
  }
}

TEST_CASE("a better preset reaches more, and a second run finds little to do") {
  const auto mesh = dovetail_test::jittered_squares(60, 0.3, 3, 0.1);
  const auto count = [&](const native& improver, triangle_mesh& result) {
    result = mesh;
    return improver(result);
  };
  triangle_mesh fast, fine, again;
  count(native::fast(), fast);
  const auto first = count(native::fine(), fine);
  CHECK(dovetail::measure_quality(fast).min_dihedrals.below(30) == 0);
  CHECK(dovetail::measure_quality(fine).min_dihedrals.below(32) == 0);
  CHECK(dovetail::measure_quality(fine).mean_min_dihedral_deg() >
        dovetail::measure_quality(fast).mean_min_dihedral_deg());
  again = fine;
  const auto second = native::fine()(again);
  check_change(fine, again);
  CHECK(second.get("edge removal accepted") < 0.05 * first.get("edge removal accepted"));
  CHECK(second.get("smoothing accepted") < 0.5 * first.get("smoothing accepted"));
  CHECK(second.get("insertion accepted") <= 2);
}

TEST_CASE("small meshes of all kinds, squeezed, shuffled, with frozen points") {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    dovetail_test::random_numbers random(seed);
    const int n = 3 + static_cast<int>(random.bits() % 8);
    const double jitter = 0.05 + 0.28 * random.unit();
    auto mesh = seed % 4 == 0   ? closed_cube(n, jitter, seed, false)
                : seed % 4 == 1 ? closed_cube(n, jitter, seed, true)
                : seed % 4 == 2 ? dovetail_test::jittered_squares(n, jitter, seed, 0.2 * random.unit())
                                : holed_squares(n + 5, jitter, seed);
    if (seed % 5 == 0)
      for (vec3& p : mesh.points)
        p.y *= 0.1;
    if (seed % 3 == 0)
      mesh = dovetail_test::shuffled(mesh, seed);
    frozen_edges frozen;
    frozen.points = static_cast<local_id>(random.bits() % (mesh.points.size() / 2));
    auto result = mesh;
    preset(seed)(result, frozen);
    check_change(mesh, result, frozen);
  }
}

TEST_CASE("two runs give the same mesh") {
  auto first = holed_squares(20, 0.3, 5), second = first;
  native::finest()(first);
  native::finest()(second);
  CHECK(first.points == second.points);
  CHECK(first.elements == second.elements);
  CHECK(first.tags == second.tags);
}

TEST_CASE("without a host, vertices stay on the given triangles, and sharp edges are kept") {
  const auto cube = closed_cube(8, 0.3, 1, false);
  auto result = cube;
  native::fine()(result);
  check_change(cube, result);
  CHECK(area_per_tag(result).at(0) == doctest::Approx(24));
  for (const vec3& p : result.points) {
    CHECK(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) == 1); // exactly on a plane
  }
  CHECK(dovetail::measure_quality(result).min_dihedral_deg > 25);

  const auto ball = closed_cube(10, 0.3, 2, true);
  result = ball;
  native::fine()(result);
  check_change(ball, result);
  CHECK(dovetail::check_validity(result).valid()); // still closed
  for (const vec3& p : result.points)
    CHECK(distance_to(ball, p) < 1e-14);
  CHECK(dovetail::measure_quality(result).min_dihedrals.below(30) == 0);
}

TEST_CASE("triangles that are turned over in the plane are mended where possible") {
  std::size_t before = 0, after = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    auto mesh = dovetail_test::jittered_squares(16, 0.45, seed, 0);
    before += turned_over(mesh);
    const auto summary = native::fine()(mesh);
    after += turned_over(mesh);
    CHECK(summary.get("after free inverted") == static_cast<double>(turned_over(mesh)));
    CHECK(summary.warnings.empty() == (turned_over(mesh) == 0));
  }
  CHECK(before > 20);
  CHECK(after < before / 10);
}

TEST_CASE("sheets that meet in a line keep it") {
  triangle_mesh mesh;
  for (int sheet = 0; sheet < 3; ++sheet) {
    const auto square = dovetail_test::jittered_squares(8, 0.25, static_cast<std::uint64_t>(sheet), 0);
    const double angle = 2.1 * sheet;
    std::vector<local_id> number;
    for (std::size_t k = 0; k < square.points.size(); ++k) {
      const vec3 p = square.points[k];
      const bool on_line = k % 9 == 0;
      const vec3 q = on_line ? vec3{0, 0, static_cast<double>(k / 9) / 8}
                             : vec3{p.x * std::cos(angle), p.x * std::sin(angle), p.y};
      if (on_line && sheet > 0) {
        number.push_back(static_cast<local_id>(k));
        continue;
      }
      number.push_back(static_cast<local_id>(mesh.points.size()));
      mesh.points.push_back(q);
    }
    for (simplex<2> triangle : square.elements) {
      for (local_id& v : triangle)
        v = number[v];
      mesh.elements.push_back(triangle);
    }
  }
  auto result = mesh;
  native::fine()(result);
  check_change(mesh, result);
  CHECK(fixed_edges(result).size() == 8 + 3 * 24);
}

TEST_CASE("edges stay in the stated band around the sizing field") {
  const auto mesh = dovetail_test::jittered_squares(20, 0.3, 4, 0);
  auto improver = native::finest();
  improver.shortest_edge = 0.6;
  improver.longest_edge = 1.6;
  const double size = 0.05;
  auto result = mesh;
  improver(result, {}, [&](vec3) { return size; });
  const auto range = [](const triangle_mesh& m) {
    std::array<double, 2> found{1e300, 0};
    for (const auto& side : dovetail::build_sides(m).vertices) {
      const double length = distance(m.points[side[0]], m.points[side[1]]);
      found = {std::min(found[0], length), std::max(found[1], length)};
    }
    return found;
  };
  const auto before = range(mesh), after = range(result);
  CHECK(after[0] >= std::min(before[0], 0.6 * size) * (1 - 1e-12));
  CHECK(after[1] <= std::max(before[1], 1.6 * size) * (1 + 1e-12));
}

TEST_CASE("a mesh that is none is refused") {
  const auto refuses = [](triangle_mesh mesh, const frozen_edges& frozen = {}) {
    CHECK_THROWS_AS(native()(mesh, frozen), dovetail::mesh_error);
  };
  const triangle_mesh good{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}}, {}};
  refuses({good.points, {{0, 1, 4}}, {}});
  refuses({good.points, {{0, 1, 1}}, {}});
  refuses({good.points, good.elements, {1}});
  refuses({good.points, {{0, 1, 2}, {1, 2, 3}}, {}}); // the second is turned over
  refuses({{{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, {{0, 1, 2}}, {}});
  refuses(good, {.sides = {{0, 3}}});
  auto small = good;
  native()(small);
  CHECK(small.elements.size() == 2);
  triangle_mesh empty;
  native()(empty);
  CHECK(empty.elements.empty());
}
