/// @file
/// The two classes of elements, counted anew by definition.
#include "dovetail/improver/tetrahedra/mesh_exchange.hpp"
#include "dovetail/improver/tetrahedra/surface_limits.hpp"
#include "improver_checks.hpp"

#include <doctest/doctest.h>

using namespace dovetail::improvement;
using namespace improver_checks;

namespace {

/// The vertices of sharp boundary triangles and of sharp boundary edges. On a manifold boundary the dihedral
/// at an edge is the sum of the dihedral angles of all elements there.
std::set<local_id> limiting_vertices(const mesh_type& mesh) {
  std::map<std::array<local_id, 3>, int> uses;
  std::map<std::array<local_id, 2>, double> dihedral;
  for (const auto& element : mesh.elements) {
    for (const auto& local : dovetail::numbering::sides<3>) {
      std::array<local_id, 3> v{};
      for (std::size_t k = 0; k < 3; ++k)
        v[k] = element[local[k]];
      std::sort(v.begin(), v.end());
      ++uses[v];
    }
    const auto angles = dovetail::dihedral_angles(dovetail::corners(std::span(mesh.points), element));
    for (std::size_t k = 0; k < 6; ++k) {
      const auto& local = dovetail::numbering::ridges<3>[k];
      const local_id a = element[local[0]], b = element[local[1]];
      dihedral[{std::min(a, b), std::max(a, b)}] += angles[k];
    }
  }
  std::set<local_id> limiting;
  for (const auto& [side, count] : uses) {
    if (count != 1)
      continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const local_id a = side[k], b = side[(k + 1) % 3], c = side[(k + 2) % 3];
      const auto at = [&](local_id v) { return mesh.points[v]; };
      const vec3 s = at(b) - at(a), t = at(c) - at(a);
      if (std::acos(dot(s, t) / (norm(s) * norm(t))) * 180 / std::numbers::pi < 20)
        limiting.insert(side.begin(), side.end());
      if (dihedral.at({std::min(a, b), std::max(a, b)}) < 48)
        limiting.insert({a, b});
    }
  }
  return limiting;
}

} // namespace

TEST_CASE("both classes are counted as defined, by a slow computation") {
  std::size_t limited = 0, rest = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    auto mesh = squeezed_cubes(3, seed, seed % 3 == 0 ? 0.25 : 0.7);
    for (auto& p : mesh.points) // sharpens two edges of the cube
      p.x += static_cast<double>(seed % 4) * 0.4 * p.y;
    REQUIRE(inverted_count(mesh) == 0);
    const auto limiting = limiting_vertices(mesh);
    quality_counts expected;
    for (const auto& element : mesh.elements) {
      const bool is_limited =
          std::any_of(element.begin(), element.end(), [&](local_id v) { return limiting.count(v) > 0; });
      auto& counted = is_limited ? expected.limited : expected.free;
      const auto angles = dovetail::dihedral_angles(dovetail::corners(std::span(mesh.points), element));
      const double smallest = *std::min_element(angles.begin(), angles.end());
      ++counted.elements;
      counted.bad += smallest < 12;
      counted.low += smallest < 24;
      counted.min_angle = std::min(counted.min_angle, smallest);
    }
    auto taken = mesh;
    const auto complex = take_mesh(taken, {});
    const auto counts = count_quality(complex, surface_limits(complex));
    for (const auto& [found, wanted] :
         {std::pair{counts.limited, expected.limited}, std::pair{counts.free, expected.free}}) {
      CHECK(found.elements == wanted.elements);
      CHECK(found.bad == wanted.bad);
      CHECK(found.low == wanted.low);
      CHECK(found.min_angle == doctest::Approx(wanted.min_angle));
    }
    limited += expected.limited.elements;
    rest += expected.free.elements;
  }
  CHECK(limited > 500);
  CHECK(rest > 500);
}
