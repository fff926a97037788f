/// @file
/// The contract that every improver of tetrahedra keeps, whatever is behind it: one test case per property,
/// tried by one test file per library.
#pragma once

#include "dovetail/core/error.hpp"
#include "improver_checks.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

namespace improver_contract {

using namespace improver_checks;

/// What an improver is tried with, and whether it changes anything at all.
template <class Improver>
struct subject {
  std::string name;
  Improver improver;
  bool changes_meshes = true;
  bool always_helps = true; ///< false: may make the worst element worse, and so have its result refused
};

/// Cubes whose inner points are where they may be bad: valid, with low elements.
inline mesh_type poor_cubes(int n, std::uint64_t seed) {
  auto mesh = tangled_cubes(n, seed, 0.24);
  while (inverted_count(mesh) > 0)
    mesh = tangled_cubes(n, ++seed + 1000, 0.2);
  return mesh;
}

template <class Improver>
void check_report(const dovetail::report& made, const mesh_type& before, const mesh_type& after,
                  const subject<Improver>& tried) {
  CHECK(made.name == "improver");
  if (!tried.changes_meshes)
    return;
  CHECK(made.get("elements before") == static_cast<double>(before.elements.size()));
  CHECK(made.get("elements after") == static_cast<double>(after.elements.size()));
}

template <class Improver>
void check_whole_contract(const subject<Improver>& tried) {
  CAPTURE(tried.name);
  const Improver& improver = tried.improver;

  // Boundary, validity, volume, worst element; and it does improve.
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const auto mesh = poor_cubes(6, seed);
    const auto result = check_contract(improver, mesh);
    check_boundary_points(mesh, result);
    auto again = mesh;
    const dovetail::report made = improver(again, {}, {});
    CHECK_MESSAGE(again.points == result.points, "two runs give the same points");
    CHECK_MESSAGE(again.elements == result.elements, "two runs give the same elements");
    check_report(made, mesh, result, tried);
    if (tried.changes_meshes && tried.always_helps) {
      CHECK_MESSAGE(made.warnings.empty(), made.warnings.front());
      const auto low = [](const mesh_type& m) {
        return dovetail::measure_quality(m).min_dihedrals.below(24);
      };
      CHECK(low(result) < low(mesh));
    }
  }

  // Materials keep their tags and their common faces.
  auto two = poor_cubes(6, 7);
  two.tags.resize(two.elements.size());
  for (std::size_t e = 0; e < two.elements.size(); ++e)
    two.tags[e] = e < two.elements.size() / 2 ? 4 : 9;
  const auto improved = check_contract(improver, two);
  CHECK(improved.tags.size() == improved.elements.size());
  check_boundary_points(two, improved);

  // Inner points and sides that the caller freezes.
  const auto mesh = poor_cubes(5, 11);
  frozen_type frozen;
  frozen.points = static_cast<local_id>(mesh.points.size() / 2);
  check_contract(improver, mesh, frozen);
  frozen.points = 0;
  frozen.sides.push_back({mesh.elements[300][1], mesh.elements[300][0], mesh.elements[300][2]});
  check_contract(improver, mesh, frozen);

  // A target size changes nothing of this.
  check_contract(improver, mesh, {}, [](vec3) { return 0.2; });

  // Inverted elements are no reason to make things worse, or to crash.
  check_contract(improver, tangled_cubes(4, 3, 0.5));

  // What is no mesh is refused.
  if (!tried.changes_meshes)
    return;
  const auto refuses = [&](mesh_type bad, const frozen_type& sides = {}) {
    CHECK_THROWS_AS(improver(bad, sides, {}), dovetail::mesh_error);
  };
  const mesh_type good{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
  refuses({good.points, {{0, 1, 2, 4}}, {}});
  refuses({good.points, good.elements, {1, 2}});
  refuses(good, {.sides = {{0, 1, 7}}});
  mesh_type three_at_side{good.points, good.elements, {}};
  three_at_side.points.insert(three_at_side.points.end(), {{1, 1, 1}, {2, 2, 2}});
  three_at_side.elements.insert(three_at_side.elements.end(), {{1, 2, 3, 4}, {1, 2, 3, 5}});
  refuses(three_at_side);
}

} // namespace improver_contract
