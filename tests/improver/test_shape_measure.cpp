/// @file
/// Shape measures: known values, invariance, and that they order elements as they say.
#include "dovetail/improver/shape_measure.hpp"
#include "dovetail/mesh/quality.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace dovetail;
using namespace dovetail::improvement;

namespace {

std::array<vec3, 4> regular() {
  return {{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}};
}

template <class Measure>
double value(const std::array<vec3, 4>& p) {
  return measure_of<Measure>(p[0], p[1], p[2], p[3]);
}

std::array<vec3, 4> random_element(dovetail_test::random_numbers& random) {
  std::array<vec3, 4> p;
  for (auto& q : p)
    q = {random.signed_unit(), random.signed_unit(), random.signed_unit()};
  return p;
}

template <class Measure>
void check_invariance() {
  dovetail_test::random_numbers random(5);
  for (int i = 0; i < 200; ++i) {
    const auto p = random_element(random);
    const double expected = value<Measure>(p);
    CHECK((expected > 0) == (signed_volume(p[0], p[1], p[2], p[3]) > 0));
    CHECK(value<Measure>({p[1], p[2], p[0], p[3]}) == doctest::Approx(expected));
    CHECK(value<Measure>({p[1], p[0], p[3], p[2]}) == doctest::Approx(expected));
    CHECK(value<Measure>({p[1], p[0], p[2], p[3]}) == doctest::Approx(-expected));
    auto scaled = p;
    for (auto& q : scaled)
      q = 1e5 * q;
    CHECK(value<Measure>(scaled) == doctest::Approx(expected));
    CHECK(expected <= value<Measure>(regular()) + 1e-12);
  }
}

} // namespace

TEST_CASE("the regular tetrahedron has the best value") {
  REQUIRE(signed_volume(regular()[0], regular()[1], regular()[2], regular()[3]) > 0);
  CHECK(value<minimum_dihedral>(regular()) == doctest::Approx(8.0 / 9));
  CHECK(value<radius_ratio>(regular()) == doctest::Approx(1));
  CHECK(value<mean_ratio>(regular()) == doctest::Approx(1));
  CHECK(value<oriented_volume>(regular()) == doctest::Approx(1));
}

TEST_CASE("measures do not depend on numbering or scale, and change sign with the orientation") {
  check_invariance<minimum_dihedral>();
  check_invariance<radius_ratio>();
  check_invariance<mean_ratio>();
  check_invariance<oriented_volume>();
}

TEST_CASE("the default measure is the squared sine of the worst dihedral angle") {
  dovetail_test::random_numbers random(8);
  for (int i = 0; i < 500; ++i) {
    auto p = random_element(random);
    if (signed_volume(p[0], p[1], p[2], p[3]) < 0)
      std::swap(p[0], p[1]);
    const auto angles = dihedral_angles(p);
    const double smallest = *std::min_element(angles.begin(), angles.end());
    const double largest = *std::max_element(angles.begin(), angles.end());
    const double small_term = minimum_dihedral::from_angle(smallest);
    const double large_term =
        largest < 90 ? 2 : minimum_dihedral::obtuse_weight * minimum_dihedral::from_angle(largest);
    CHECK(value<minimum_dihedral>(p) == doctest::Approx(std::min(small_term, large_term)).epsilon(1e-6));
    // What the target means: a value above it has no smaller angle.
    if (value<minimum_dihedral>(p) > minimum_dihedral::from_angle(24))
      CHECK(smallest > 24);
  }
}

TEST_CASE("degenerate elements have no positive value") {
  const std::array<vec3, 4> flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  const std::array<vec3, 4> needle{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}};
  for (const auto& p : {flat, needle}) {
    CHECK_FALSE(value<minimum_dihedral>(p) > 0);
    CHECK_FALSE(value<radius_ratio>(p) > 0);
    CHECK_FALSE(value<mean_ratio>(p) > 0);
    CHECK_FALSE(value<oriented_volume>(p) > 0);
  }
}
