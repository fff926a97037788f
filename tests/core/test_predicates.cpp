#include "dovetail/core/predicates.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

using namespace dovetail;
using rational = boost::multiprecision::cpp_rational;

namespace {

int sign_of(const rational& value) {
  return value.sign();
}
int sign_of(double value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

int orient3d_by_rationals(vec3 a, vec3 b, vec3 c, vec3 d) {
  rational m[3][3];
  const vec3* corners[3] = {&b, &c, &d};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      m[i][k] = rational((*corners[i])[k]) - rational(a[k]);
  const rational det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return sign_of(det);
}

int orient2d_by_rationals(vec2 a, vec2 b, vec2 c) {
  const rational det = (rational(b.x) - rational(a.x)) * (rational(c.y) - rational(a.y)) -
                       (rational(b.y) - rational(a.y)) * (rational(c.x) - rational(a.x));
  return sign_of(det);
}

int in_circle_by_rationals(vec2 a, vec2 b, vec2 c, vec2 d) {
  rational m[3][3];
  const vec2* corners[3] = {&a, &b, &c};
  for (int i = 0; i < 3; ++i) {
    m[i][0] = rational(corners[i]->x) - rational(d.x);
    m[i][1] = rational(corners[i]->y) - rational(d.y);
    m[i][2] = m[i][0] * m[i][0] + m[i][1] * m[i][1];
  }
  const rational det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return sign_of(det);
}

/// The determinant of lifted points by cofactors, with the sign of the tetrahedron's orientation undone.
int in_sphere_by_rationals(vec3 a, vec3 b, vec3 c, vec3 d, vec3 e) {
  rational m[4][4];
  const vec3* corners[4] = {&a, &b, &c, &d};
  for (int i = 0; i < 4; ++i) {
    m[i][3] = 0;
    for (int k = 0; k < 3; ++k) {
      m[i][k] = rational((*corners[i])[k]) - rational(e[k]);
      m[i][3] += m[i][k] * m[i][k];
    }
  }
  const auto minor = [&](int p, int q, int r) {
    return m[p][0] * (m[q][1] * m[r][2] - m[q][2] * m[r][1]) -
           m[p][1] * (m[q][0] * m[r][2] - m[q][2] * m[r][0]) +
           m[p][2] * (m[q][0] * m[r][1] - m[q][1] * m[r][0]);
  };
  return sign_of(rational(m[0][3] * minor(1, 2, 3) - m[1][3] * minor(0, 2, 3) + m[2][3] * minor(0, 1, 3) -
                          m[3][3] * minor(0, 1, 2)));
}

/// A random point of a coarse lattice with a tiny disturbance now and then: many exact and nearly exact ties.
struct nearly_degenerate_points {
  std::mt19937 engine{12345};
  double coordinate() {
    double value = std::uniform_int_distribution<int>(-4, 4)(engine) * 0.1;
    if (engine() % 3 == 0 && value != 0) // next to zero come denormal numbers, whose products underflow
      value = std::nextafter(value, value + (engine() % 2 == 0 ? 1 : -1));
    return value;
  }
  vec2 plane() { return {coordinate(), coordinate()}; }
  vec3 space() { return {coordinate(), coordinate(), coordinate()}; }
};

} // namespace

TEST_CASE("the predicates have the sign of rational arithmetic on nearly degenerate points") {
  nearly_degenerate_points random;
  int zeros = 0, spheres = 0;
  for (int i = 0; i < 3000; ++i) {
    const vec3 a = random.space(), b = random.space(), c = random.space(), d = random.space();
    const vec3 e = random.space();
    REQUIRE(sign_of(in_sphere(a, b, c, d, e)) == in_sphere_by_rationals(a, b, c, d, e));
    spheres += in_sphere(a, b, c, d, e) == 0 && orient3d(a, b, c, d) != 0;
    REQUIRE(sign_of(orient3d(a, b, c, d)) == orient3d_by_rationals(a, b, c, d));
    const vec2 p = random.plane(), q = random.plane(), r = random.plane(), s = random.plane();
    REQUIRE(sign_of(orient2d(p, q, r)) == orient2d_by_rationals(p, q, r));
    REQUIRE(sign_of(in_circle(p, q, r, s)) == in_circle_by_rationals(p, q, r, s));
    zeros += orient2d(p, q, r) == 0;
  }
  CHECK(zeros > 0);
  CHECK(spheres > 0);
}

TEST_CASE("integers and expansions have the same sign where both can be used") {
  std::mt19937 engine(7);
  int used = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<double, 12> a{}, b{};
    for (double& value : a)
      value = (1 + std::uniform_int_distribution<int>(-3, 3)(engine)) * 0x1p-20 *
              (1 + 0x1p-30 * std::uniform_int_distribution<int>(0, 3)(engine));
    for (std::size_t k = 0; k < 12; ++k)
      b[k] = k < 3 ? 0x1p-20 * std::uniform_int_distribution<int>(0, 4)(engine) : b[k - 3];
    std::array<detail::fixed_integer<1>, 12> integers;
    if (!detail::integer_differences(a, b, integers))
      continue;
    ++used;
    std::array<detail::expansion<2>, 12> expansions;
    for (std::size_t k = 0; k < 12; ++k)
      expansions[k] = detail::exact_difference(a[k], b[k]);
    REQUIRE(detail::sphere_determinant(integers).sign() == detail::sphere_determinant(expansions).sign());
    a[engine() % 12] *= 1 + 0x1p-52; // too fine for one word
    std::array<detail::fixed_integer<2>, 12> wider;
    REQUIRE(detail::integer_differences(a, b, wider));
    for (std::size_t k = 0; k < 12; ++k)
      expansions[k] = detail::exact_difference(a[k], b[k]);
    REQUIRE(detail::sphere_determinant(wider).sign() == detail::sphere_determinant(expansions).sign());
  }
  CHECK(used > 1000);
}

TEST_CASE("integers as wide as they can get do not overflow") {
  const double most = 0x1p61 - 0x1p8; // the largest double below 2^61
  for (const double s : {1.0, -1.0}) {
    std::array<detail::fixed_integer<1>, 12> integers;
    std::array<double, 12> a{s * most, most, most, most, -most, most, -most, most, most, most, most, -most};
    REQUIRE(detail::integer_differences(a, {}, integers));
    std::array<detail::expansion<2>, 12> expansions;
    for (std::size_t k = 0; k < 12; ++k)
      expansions[k] = detail::exact_difference(a[k], 0);
    CHECK(detail::sphere_determinant(integers).sign() == detail::sphere_determinant(expansions).sign());
    std::array<detail::fixed_integer<2>, 12> wider;
    for (double& value : a)
      value = std::copysign(1 - 0x1p-53, value);
    std::array<double, 12> b{};
    for (std::size_t k = 0; k < 12; ++k) {
      b[k] = -0x1p-53 * a[k]; // their difference is rounded up
      expansions[k] = detail::exact_difference(a[k], b[k]);
    }
    REQUIRE(detail::integer_differences(a, b, wider));
    CHECK(detail::sphere_determinant(wider).sign() == detail::sphere_determinant(expansions).sign());
  }
  std::array<detail::fixed_integer<1>, 1> integer;
  CHECK_FALSE(detail::integer_differences<1, 1>({1.0}, {1e-30}, integer)); // their difference is rounded
  CHECK(detail::integer_differences<1, 1>({0.25}, {0.25}, integer));
  CHECK(integer[0].sign() == 0);
}

TEST_CASE("signs follow the documented conventions") {
  CHECK(orient2d({0, 0}, {1, 0}, {0, 1}) > 0);
  CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) > 0);
  CHECK(in_circle({0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}) > 0);
  CHECK(in_circle({0, 0}, {1, 0}, {0, 1}, {1, 1}) == 0);
  CHECK(in_circle({0, 0}, {1, 0}, {0, 1}, {2, 2}) < 0);
  CHECK(in_sphere({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0.5}) > 0);
  CHECK(in_sphere({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}) == 0);
  CHECK(in_sphere({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}) < 0);
}
