/// @file
/// The native improver keeps its promises: objectives, materials, frozen entities, sizes, tangled inputs.
#include "dovetail/improver/native.hpp"
#include "improver_checks.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>

using namespace improver_checks;
using dovetail::improvement::native;

static_assert(dovetail::improver<native, 3>);
static_assert(dovetail::improver<dovetail::no_improver, 3>);
static_assert(dovetail::improver<dovetail::no_improver, 2>);

namespace {

native preset(std::uint64_t i) {
  return i % 4 == 0   ? native::fast()
         : i % 4 == 1 ? native::fine()
         : i % 4 == 2 ? native::finest()
                      : native::hard();
}

/// Poor but valid meshes of different kinds.
mesh_type random_start(std::uint64_t seed) {
  const int n = seed % 8 == 0 ? 3 : 2;
  const double squeeze = seed % 5 == 0 ? 0.05 : seed % 5 == 1 ? 0.3 : 1;
  auto mesh = squeezed_cubes(n, seed, squeeze);
  return seed % 2 == 0 ? mesh : dovetail_test::shuffled(mesh, seed);
}

} // namespace

TEST_CASE(
    "squeezed and sheared cubes stay valid and do not get worse") { // test_random_meshes has ten thousand
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    CAPTURE(seed);
    const auto mesh = random_start(seed);
    const auto result = check_contract(preset(seed), mesh);
    check_boundary_points(mesh, result);
  }
}

TEST_CASE("every objective keeps the contract") {
  using dovetail::improvement::objective;
  for (const auto kind : {objective::minimum_dihedral, objective::radius_ratio, objective::mean_ratio})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      auto improver = native::fine();
      improver.objective = kind;
      auto mesh = random_start(seed);
      improver(mesh, {}, {});
      const auto validity = dovetail::check_validity(mesh);
      CHECK_MESSAGE(validity.valid(), validity.text());
    }
}

TEST_CASE("materials keep their volume and their common sides") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    auto mesh = random_start(seed);
    dovetail_test::random_numbers random(seed);
    mesh.tags.resize(mesh.elements.size());
    const vec3 normal{random.signed_unit(), random.signed_unit(), random.signed_unit()};
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const auto p = dovetail::corners(std::span(mesh.points), mesh.elements[e]);
      mesh.tags[e] = dot(normal, p[0] + p[1] + p[2] + p[3]) > 1 ? 7 : 3;
    }
    check_contract(preset(seed), mesh);
  }
}

TEST_CASE("frozen inner sides and points are kept") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const auto mesh = random_start(seed);
    dovetail_test::random_numbers random(seed + 1000);
    frozen_type frozen;
    frozen.points = static_cast<local_id>(random.bits() % mesh.points.size());
    for (const auto& element : mesh.elements)
      if (random.unit() < 0.05)
        frozen.sides.push_back({element[1], element[0], element[2]});
    check_contract(preset(seed), mesh, frozen);
  }
}

TEST_CASE("a poor mesh becomes good") {
  const auto mesh = dovetail_test::jittered_cubes(8, 0.2, 3);
  REQUIRE(inverted_count(mesh) == 0);
  const auto before = dovetail::measure_quality(mesh);
  const auto result = check_contract(native::finest(), mesh);
  const auto after = dovetail::measure_quality(result);
  REQUIRE(before.min_dihedral_deg < 24);
  CHECK(after.min_dihedral_deg > 24);
  CHECK(after.per_million_under(24) == 0);
}

TEST_CASE("the same input gives the same mesh, bit for bit") {
  const auto mesh = squeezed_cubes(6, 11, 0.4);
  auto one = mesh, other = mesh;
  native::finest()(one, {}, {});
  native::finest()(other, {}, {});
  CHECK(one.points == other.points);
  CHECK(one.elements == other.elements);
}

TEST_CASE("a far-away or tiny mesh is improved like one at the origin") {
  // Scaling and moving by powers of two keeps the differences of coordinates exact enough to decide alike.
  const auto mesh = dovetail_test::jittered_cubes(4, 0.14, 5);
  for (const double scale : {std::ldexp(1.0, -40), std::ldexp(1.0, 40)}) {
    auto scaled = mesh;
    for (auto& p : scaled.points)
      p = scale * p;
    const auto result = check_contract(native::fine(), scaled);
    CHECK(dovetail::measure_quality(result).min_dihedral_deg > 24);
  }
}

TEST_CASE("edges stay in the band around the size") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const auto mesh = random_start(seed);
    double shortest = 1e300, longest = 0;
    const auto measure = [](const mesh_type& m, double& low, double& high) {
      for (const auto& element : m.elements)
        for (const auto& edge : dovetail::numbering::ridges<3>) {
          const double length = distance(m.points[element[edge[0]]], m.points[element[edge[1]]]);
          low = std::min(low, length);
          high = std::max(high, length);
        }
    };
    measure(mesh, shortest, longest);
    const double size = 0.25;
    auto improver = native::finest();
    improver.shortest_edge = 0.5;
    improver.longest_edge = 1.6;
    for (const double bad_angle : {0.0, 15.0}) {
      improver.bad_angle = bad_angle;
      auto result = mesh;
      improver(result, {}, [size](vec3) { return size; });
      double new_shortest = 1e300, new_longest = 0;
      measure(result, new_shortest, new_longest);
      const double least = (bad_angle > 0 ? 0.25 : 1) * 0.5 * size; // bad ones are mended with shorter edges
      CHECK(new_shortest >= std::min(shortest, least) * (1 - 1e-12));
      CHECK(new_longest <= std::max(longest, 1.6 * size) * (1 + 1e-12));
    }
  }
}

TEST_CASE("few elements stay bad beside details that are much smaller than the size") {
  std::int64_t bad = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    auto mesh = squeezed_cubes(3, seed, 0.12);
    REQUIRE(dovetail::measure_quality(mesh).per_million_under(12) > 0);
    native::fine()(mesh, {}, [](vec3) { return 2.0; });
    const auto quality = dovetail::measure_quality(mesh);
    bad += std::llround(1e-6 * quality.per_million_under(12) * static_cast<double>(quality.elements));
  }
  CHECK(bad < 60); // with no edge shorter than usual about 160
}

TEST_CASE("inverted elements are untangled where possible, and reported otherwise") {
  std::size_t untangled = 0, tangled = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    const auto mesh = tangled_cubes(2 + static_cast<int>(seed % 3), seed, 0.9);
    const std::size_t before = inverted_count(mesh);
    if (before == 0)
      continue;
    auto result = mesh;
    const auto report = native::fine()(result, {}, {});
    const std::size_t after = inverted_count(result);
    CHECK(after <= before);
    CHECK(report.get("inverted before") == static_cast<double>(before));
    CHECK(report.get("inverted after") == static_cast<double>(after));
    CHECK(report.warnings.empty() == (after == 0));
    CHECK(outer_and_material_sides(result) == outer_and_material_sides(mesh));
    ++tangled;
    if (after == 0) {
      ++untangled;
      const auto validity = dovetail::check_validity(result);
      CHECK_MESSAGE(validity.valid(), validity.text());
    }
  }
  REQUIRE(tangled > 20);
  CHECK_MESSAGE(untangled * 10 >= tangled * 9, untangled << " of " << tangled << " untangled");
}

TEST_CASE("flat elements are mended") {
  // Two coplanar points on either side of an edge: a square of four points in one plane as an element.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    auto mesh = dovetail_test::jittered_cubes(4, 0.1, seed);
    const auto& first = mesh.elements[200];
    local_id inner = dovetail::no_id;
    for (const local_id v : first) {
      const vec3 p = mesh.points[v];
      if (p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1 && p.z > 0 && p.z < 1)
        inner = v;
    }
    if (inner == dovetail::no_id)
      continue;
    vec3 sum{};
    for (const local_id v : first)
      if (v != inner)
        sum += mesh.points[v];
    mesh.points[inner] = sum / 3;
    native::fine()(mesh, {}, {});
    CHECK(inverted_count(mesh) == 0);
  }
}

TEST_CASE("an input that is not a mesh is refused with a typed error") {
  const auto good = dovetail_test::jittered_cubes(2);
  auto missing_point = good;
  missing_point.elements[3][1] = 1000;
  CHECK_THROWS_AS(native{}(missing_point, {}, {}), dovetail::mesh_error);
  auto repeated = good;
  repeated.elements[3][1] = repeated.elements[3][0];
  CHECK_THROWS_AS(native{}(repeated, {}, {}), dovetail::mesh_error);
  auto doubled = good;
  doubled.elements.push_back(doubled.elements.front());
  CHECK_THROWS_AS(native{}(doubled, {}, {}), dovetail::mesh_error);
  auto tags = good;
  tags.tags = {1, 2};
  CHECK_THROWS_AS(native{}(tags, {}, {}), dovetail::mesh_error);
  auto mesh = good;
  CHECK_THROWS_WITH_AS(native{}(mesh, {.points = 0, .sides = {{0, 1, 999}}}, {}),
                       "frozen side (0, 1, 999) is not a side of the mesh", dovetail::mesh_error);
}

TEST_CASE("an empty mesh and a single element are left alone") {
  mesh_type empty;
  CHECK_NOTHROW(native{}(empty, {}, {}));
  mesh_type one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}}, {{0, 1, 2, 3}}, {}};
  const auto before = one;
  native::finest()(one, {}, {});
  CHECK(one.elements == before.elements);
  CHECK(one.points == before.points);
}

TEST_CASE("the report counts operations and both classes") {
  auto mesh = squeezed_cubes(6, 2, 1);
  const auto report = native::fine()(mesh, {}, {});
  CHECK(report.get("elements after") == static_cast<double>(mesh.elements.size()));
  CHECK(report.get("edge removal tried") > 0);
  CHECK(report.get("edge removal accepted") <= report.get("edge removal tried"));
  CHECK(report.get("after free elements") + report.get("after limited elements") ==
        static_cast<double>(mesh.elements.size()));
  const auto quality = dovetail::measure_quality(mesh);
  CHECK(std::min(report.get("after free min angle"), report.get("after limited min angle")) ==
        doctest::Approx(quality.min_dihedral_deg).epsilon(1e-6));
  CHECK(report.get("after free low") + report.get("after limited low") ==
        static_cast<double>(quality.min_dihedrals.below(24)));
}
