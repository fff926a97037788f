/// @file
/// The move of all free vertices: where it goes, and what it never does.
#include "dovetail/improver/native.hpp"
#include "dovetail/improver/tetrahedra/global_smoothing.hpp"
#include "dovetail/improver/tetrahedra/mesh_exchange.hpp"
#include "improver_checks.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace dovetail::improvement;
using namespace improver_checks;

namespace {

using measure = minimum_dihedral;

float value_of(const tet_complex& mesh, local_id e) {
  const auto& v = mesh.vertices(e);
  return static_cast<float>(
      measure_of<measure>(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])));
}

tet_complex judged_complex(mesh_type mesh) {
  tet_complex complex = take_mesh(mesh, {});
  for (local_id e = 0; e < complex.element_slots(); ++e)
    complex.set_value(e, value_of(complex, e));
  complex.set_sizes(present_sizes(complex));
  return complex;
}

std::vector<float> values_of(const tet_complex& mesh) {
  return {mesh.values().begin(), mesh.values().end()};
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values)
    sum += static_cast<double>(value);
  return sum / static_cast<double>(values.size());
}

/// The centre of the sphere through the corners, from the three planes halfway to the other ones.
vec3 circumcentre(const std::array<vec3, 4>& p) {
  const vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const double determinant = dot(a, cross(b, c));
  const double x = norm_squared(a) / 2, y = norm_squared(b) / 2, z = norm_squared(c) / 2;
  return p[0] + (x * cross(b, c) + y * cross(c, a) + z * cross(a, b)) / determinant;
}

/// Only the pass, and nothing else.
native alone(int sweeps) {
  native improver;
  improver.passes = improver.hard_passes = 0;
  improver.global_passes = sweeps;
  return improver;
}

} // namespace

TEST_CASE("a vertex goes to the weighted average of the circumcentres, or half way") {
  int moved = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    CAPTURE(seed);
    tet_complex mesh = judged_complex(dovetail_test::jittered_cubes(2, 0.15, seed)); // one inner vertex
    local_id inner = 0;
    while (!mesh.is_free(inner))
      ++inner;
    vec3 sum{};
    double weights = 0;
    for (local_id e = 0; e < mesh.element_slots(); ++e) {
      const auto& v = mesh.vertices(e);
      if (std::find(v.begin(), v.end(), inner) == v.end())
        continue;
      std::array<vec3, 4> p;
      double size = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        p[k] = mesh.point(v[k]);
        size += static_cast<double>(mesh.size_at(v[k])) / 4;
      }
      const double weight = dovetail::signed_volume(p[0], p[1], p[2], p[3]) / std::pow(size, 5);
      sum += weight * circumcentre(p);
      weights += weight;
    }
    const vec3 from = mesh.point(inner), all_the_way = sum / weights;
    const bool accepted = global_smoothing<measure>().improve(mesh, inner, {});
    const vec3 now = mesh.point(inner);
    if (accepted)
      CHECK(std::min(distance(now, all_the_way), distance(now, midpoint(from, all_the_way))) < 1e-12);
    else
      CHECK(now == from);
    moved += accepted;
  }
  CHECK(moved > 10);
}

TEST_CASE("no element gets worse than the worst around its vertex was, and no poor one gets worse") {
  const auto target = static_cast<float>(measure::from_angle(25));
  std::size_t moved = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    tet_complex mesh = judged_complex(squeezed_cubes(4, seed, seed % 3 == 0 ? 0.3 : 1));
    global_smoothing<measure> smoothing;
    const global_smoothing_limits limits{.must_raise_mean = seed % 2 == 0, .target = target};
    for (local_id v = 0; v < mesh.vertex_slots(); ++v) {
      if (!mesh.is_free(v))
        continue;
      const auto before = values_of(mesh);
      const vec3 from = mesh.point(v);
      const bool accepted = smoothing.improve(mesh, v, limits);
      CHECK(accepted == !(mesh.point(v) == from));
      moved += accepted;
      float worst_before = 2, worst_after = 2;
      double gain = 0;
      for (local_id e = 0; e < mesh.element_slots(); ++e) {
        const auto& corners = mesh.vertices(e);
        const float was = before[e], is = value_of(mesh, e);
        CHECK(is == mesh.value(e)); // what is remembered is true
        if (std::find(corners.begin(), corners.end(), v) == corners.end()) {
          CHECK(is == was);
          continue;
        }
        worst_before = std::min(worst_before, was);
        worst_after = std::min(worst_after, is);
        gain += static_cast<double>(is) - static_cast<double>(was);
        CHECK(is >= std::min(was, target));
      }
      if (accepted) {
        CHECK(worst_after > worst_before);
        CHECK((gain > 0 || !limits.must_raise_mean));
      }
    }
    CHECK(mesh.is_consistent());
  }
  CHECK(moved > 20);
}

TEST_CASE("the mean rises, and with it the worst does not fall") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    CAPTURE(seed);
    tet_complex mesh = judged_complex(dovetail_test::jittered_cubes(8, 0.15, seed));
    const auto before = values_of(mesh);
    const auto counts = global_smoothing<measure>().run(mesh, {.passes = 2});
    const auto after = values_of(mesh);
    CHECK(counts.tried == 2 * 7 * 7 * 7);
    CHECK(counts.accepted > counts.tried / 4);
    CHECK(mean(after) > 1.02 * mean(before));
    CHECK(*std::min_element(after.begin(), after.end()) >= *std::min_element(before.begin(), before.end()));
  }
}

TEST_CASE("alone it keeps the connections, the boundary and what is frozen") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    CAPTURE(seed);
    const auto mesh = dovetail_test::shuffled(squeezed_cubes(5, seed, 0.7), seed);
    frozen_type frozen;
    frozen.points = static_cast<local_id>(mesh.points.size() / 3);
    auto result = check_contract(alone(2), mesh, frozen);
    check_boundary_points(mesh, result);
    CHECK(result.elements.size() == mesh.elements.size());
    CHECK(result.points.size() == mesh.points.size());
    std::size_t moved = 0;
    for (const vec3 p : result.points)
      moved += std::find(mesh.points.begin(), mesh.points.end(), p) == mesh.points.end();
    CHECK(moved > 0);
  }
}

TEST_CASE("edges stay in the band around a sizing field") {
  const dovetail::any_sizing field = [](vec3) { return 0.25; };
  const global_smoothing_limits limits{.must_raise_mean = false, .band = {&field, 0.8, 1.2}};
  std::size_t moved = 0;
  tet_complex mesh = judged_complex(dovetail_test::jittered_cubes(5, 0.15, 3));
  const auto lengths_at = [&mesh](local_id v) {
    edge_lengths lengths;
    for (local_id e = 0; e < mesh.element_slots(); ++e) {
      const auto& corners = mesh.vertices(e);
      if (std::find(corners.begin(), corners.end(), v) != corners.end())
        for (const local_id other : corners)
          if (other != v)
            lengths.add(mesh.point(v), mesh.point(other));
    }
    return lengths;
  };
  global_smoothing<measure> smoothing;
  for (local_id v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_free(v)) {
      const auto before = lengths_at(v);
      moved += smoothing.improve(mesh, v, limits);
      const auto after = lengths_at(v);
      CHECK(after.shortest >= std::min(before.shortest, 0.2 * 0.2));
      CHECK(after.longest <= std::max(before.longest, 0.3 * 0.3));
    }
  CHECK(moved > 5);
}

TEST_CASE("the pass is deterministic, and none by default but in finest") {
  CHECK(native::fast().global_passes == 0);
  CHECK(native::fine().global_passes == 0);
  CHECK(native::finest().global_passes == 1);
  const auto mesh = squeezed_cubes(6, 11, 0.6);
  auto one = mesh, other = mesh;
  alone(2)(one, {}, {});
  alone(2)(other, {}, {});
  CHECK(one.points == other.points);
  CHECK(one.elements == other.elements);
}
