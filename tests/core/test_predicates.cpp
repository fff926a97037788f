#include "dovetail/core/predicates.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <doctest/doctest.h>

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
  int zeros = 0;
  for (int i = 0; i < 3000; ++i) {
    const vec3 a = random.space(), b = random.space(), c = random.space(), d = random.space();
    REQUIRE(sign_of(orient3d(a, b, c, d)) == orient3d_by_rationals(a, b, c, d));
    const vec2 p = random.plane(), q = random.plane(), r = random.plane(), s = random.plane();
    REQUIRE(sign_of(orient2d(p, q, r)) == orient2d_by_rationals(p, q, r));
    REQUIRE(sign_of(in_circle(p, q, r, s)) == in_circle_by_rationals(p, q, r, s));
    zeros += orient2d(p, q, r) == 0;
  }
  CHECK(zeros > 0);
}

TEST_CASE("signs follow the documented conventions") {
  CHECK(orient2d({0, 0}, {1, 0}, {0, 1}) > 0);
  CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) > 0);
  CHECK(in_circle({0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}) > 0);
  CHECK(in_circle({0, 0}, {1, 0}, {0, 1}, {1, 1}) == 0);
  CHECK(in_circle({0, 0}, {1, 0}, {0, 1}, {2, 2}) < 0);
}
