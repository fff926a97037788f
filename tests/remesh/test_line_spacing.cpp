#include "dovetail/remesh/line_spacing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace dovetail;

namespace {

constexpr double half_turn = std::numbers::pi;

const auto straight = [](double t) { return curve_frame{{t, 0, 0}, {1, 0, 0}}; };
const auto circle = [](double t) {
  return curve_frame{{std::cos(t), std::sin(t), 0}, {-std::sin(t), std::cos(t), 0}};
};
/// A straight line run at uneven speed.
const auto uneven = [](double t) { return curve_frame{{t * t * t, 0, 0}, {3 * t * t, 0, 0}}; };

} // namespace

TEST_CASE("a uniform size gives equal segments, as many as the length asks") {
  const remesh::line_spacing spacing;
  const auto t = spacing(straight, 0, 10, [](vec3) { return 0.5; });
  REQUIRE(t.size() == 21);
  for (std::size_t i = 0; i < t.size(); ++i)
    CHECK(t[i] == doctest::Approx(0.5 * static_cast<double>(i)));
  CHECK(t.front() == 0);
  CHECK(t.back() == 10);
}

TEST_CASE("spacing follows length, not the parameter") {
  const auto t = remesh::line_spacing{}(uneven, 0, 2, [](vec3) { return 0.1; });
  REQUIRE(t.size() == 81);
  for (std::size_t i = 1; i < t.size(); ++i)
    CHECK(std::pow(t[i], 3) - std::pow(t[i - 1], 3) == doctest::Approx(0.1).epsilon(0.05));
}

TEST_CASE("neighbouring segments follow a graded size") {
  const auto size = [](vec3 p) { return 0.01 + 0.2 * std::abs(p.x - 3); };
  const auto t = remesh::line_spacing{}(straight, 0, 10, size);
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double wanted = size({0.5 * (t[i] + t[i - 1]), 0, 0});
    CHECK((t[i] - t[i - 1]) / wanted > 0.85);
    CHECK((t[i] - t[i - 1]) / wanted < 1.2);
  }
}

TEST_CASE("options: least number of segments and largest turn") {
  const auto large = [](vec3) { return 100.0; };
  CHECK(remesh::line_spacing{}(circle, 0, 2 * half_turn, large).size() == 2);
  CHECK(remesh::line_spacing{.minimum_segments = 3}(circle, 0, 2 * half_turn, large).size() == 4);
  CHECK(remesh::line_spacing{.largest_turn = half_turn / 4}(circle, 0, 2 * half_turn, large).size() == 9);
  const remesh::line_spacing floored{.largest_turn = half_turn / 4, .smallest_turn_size = 10};
  CHECK(floored(circle, 0, 2 * half_turn, large).size() == 2);
}

TEST_CASE("few segments become one, two or four when asked to") {
  const remesh::line_spacing even{.even_when_few = true};
  const auto segments = [&](double length) {
    return even(straight, 0, length, [](vec3) { return 1.0; }).size() - 1;
  };
  CHECK(segments(0.3) == 1);
  CHECK(segments(1.1) == 1);
  CHECK(segments(1.3) == 2);
  CHECK(segments(3.1) == 2);
  CHECK(segments(3.3) == 4);
  CHECK(segments(4.4) == 4);
  CHECK(segments(4.6) == 5);
  CHECK(segments(7.4) == 7);
}

TEST_CASE("as many segments as are given, even or growing shorter, and the same when no bias is given") {
  const auto size = [](vec3) { return 1.0; };
  CHECK(remesh::line_spacing{.given_segments = 3}(straight, 0, 10, size).size() == 4);
  const auto biased = remesh::line_spacing{.given_segments = 3, .bias = 0.4}(straight, 0, 9, size);
  REQUIRE(biased.size() == 4);
  CHECK(biased[1] == doctest::Approx(3 + 9 * 0.4 * 2 / 9));
  CHECK(biased[1] - biased[0] > biased[2] - biased[1]);
  CHECK(biased[2] - biased[1] > biased[3] - biased[2]);
  CHECK(remesh::line_spacing{.given_segments = 10}(straight, 0, 10, size) ==
        remesh::line_spacing{}(straight, 0, 10, size));
}

TEST_CASE("the result is a pure function and increasing, also on a line of length zero") {
  const auto size = [](vec3 p) { return 0.02 + 0.1 * std::abs(std::sin(7 * p.x)); };
  const auto once = remesh::line_spacing{}(circle, 0.3, 5, size),
             again = remesh::line_spacing{}(circle, 0.3, 5, size);
  CHECK(once == again);
  CHECK(std::is_sorted(once.begin(), once.end()));
  const auto nothing = [](double) { return curve_frame{}; };
  CHECK(remesh::line_spacing{.minimum_segments = 2}(nothing, 0, 1, size).size() == 3);
}
