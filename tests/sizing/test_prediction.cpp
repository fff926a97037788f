#include "dovetail/sizing/coarse.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/prediction.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <numeric>

using namespace dovetail;

namespace {

/// A box of n^3 cubes, six tetrahedra each, all around the cube's diagonal.
simplicial_mesh<3> box_mesh(vec3 lower, vec3 upper, int n) {
  simplicial_mesh<3> mesh;
  const auto id = [&](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.points.push_back({lower.x + (upper.x - lower.x) * i / n, lower.y + (upper.y - lower.y) * j / n,
                               lower.z + (upper.z - lower.z) * k / n});
  const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const auto& axes : order) {
          std::array<int, 3> at{i, j, k};
          simplex<3> tet;
          tet[0] = id(at[0], at[1], at[2]);
          for (std::size_t s = 0; s < 3; ++s) {
            ++at[axes[s]];
            tet[s + 1] = id(at[0], at[1], at[2]);
          }
          mesh.elements.push_back(tet);
        }
  return mesh;
}

simplicial_mesh<2> square_mesh() {
  simplicial_mesh<2> mesh;
  mesh.points = {{0, 0, 1}, {3, 0, 1}, {3, 3, 1}, {0, 3, 1}};
  mesh.elements = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Integral of h^-3 over all space around one point source: the radial integral by 10^6 midpoints.
double radial_integral(const source_field& h, double radius) {
  double sum = 0;
  const int n = 1000000;
  for (int i = 0; i < n; ++i) {
    const double r = (i + 0.5) * radius / n;
    sum += 4 * std::numbers::pi * r * r / std::pow(h({r, 0, 0}), 3) * radius / n;
  }
  return sum;
}

} // namespace

TEST_CASE("a uniform size gives volume over size cubed, shared out by volume") {
  const auto mesh = box_mesh({0, 0, 0}, {1, 2, 3}, 2);
  const auto p = predict_elements(mesh, uniform_size(0.1), {.density = 8.0});
  CHECK(p.elements == doctest::Approx(6 / 1e-3 * 8));
  REQUIRE(p.per_element.size() == mesh.elements.size());
  for (const double share : p.per_element)
    CHECK(share == doctest::Approx(p.elements / 48));
  CHECK(predict_elements(mesh, uniform_size(0.1)).elements == doctest::Approx(6000 * 6 * std::sqrt(2.0)));
  CHECK(predict_elements(square_mesh(), uniform_size(0.5)).elements ==
        doctest::Approx(36 * 4 / std::sqrt(3.0)));
}

TEST_CASE("a tiny source in a huge coarse mesh is not missed") {
  // 1e-3 wide in a box 100 wide: 1e-15 of the volume, and most of the elements.
  const source_field h(10.0, {point_source({0, 0, 0}, 1e-3, 0.1, 1e-5)});
  const auto mesh = box_mesh({-53, -47, -51}, {47, 49, 50}, 1);
  const double volume_outside = 100.0 * 96 * 101 - 4.0 / 3 * std::numbers::pi * 1e-3;
  const double exact = radial_integral(h, 0.1) + volume_outside / 1e3;
  const auto p = predict_elements(mesh, h, {.density = 1});
  MESSAGE("cells ", p.cells, ", relative error ", p.elements / exact - 1);
  CHECK(p.elements == doctest::Approx(exact).epsilon(0.05));
  CHECK(p.relative_error <= 0.05);
  CHECK(std::accumulate(p.per_element.begin(), p.per_element.end(), 0.0) == doctest::Approx(p.elements));
  // The same through the run-time type, and through compositions.
  const auto erased = predict_elements(mesh, keep_bounds(minimum_of(h, uniform_size(20))), {.density = 1});
  CHECK(erased.elements == doctest::Approx(exact).epsilon(0.05));
}

TEST_CASE("many sources of all kinds: 5 per cent against a refined mesh and a tenfold tolerance") {
  std::vector<grid_source> sources;
  for (int i = 0; i < 30; ++i) {
    const double x = 0.3 * i;
    sources.push_back(line_source({x, 1, 1}, {x, 1 + 0.2 * i, 2}, 0.05, 0.6, 0.01 + 0.001 * i));
    sources.push_back(point_source({x, 5, 5 + std::sin(x)}, 0.02, 0.7, 0.004));
    sources.push_back(triangle_source({x, 7, 2}, {x + 0.5, 8, 2}, {x, 7, 2.5}, 0.05, 1, 0.02));
  }
  const source_field h(0.8, sources);
  const auto p = predict_elements(box_mesh({0, 0, 0}, {9, 9, 9}, 4), h);
  const auto reference = predict_elements(box_mesh({0, 0, 0}, {9, 9, 9}, 9), h, {.relative_error = 0.004});
  MESSAGE("cells ", p.cells, " against ", reference.cells, ", elements ", p.elements, " against ",
          reference.elements);
  CHECK(p.relative_error <= 0.05);
  CHECK(p.elements == doctest::Approx(reference.elements).epsilon(0.05));
}

TEST_CASE("a field without bounds is sampled everywhere") {
  const any_sizing h = [](vec3 p) { return distance(p, {0.3, 0.4, 0.6}) < 0.1 ? 0.002 : 0.2; };
  const double ball = 4.0 / 3 * std::numbers::pi * 1e-3;
  const double exact = ball / std::pow(0.002, 3) + (1 - ball) / 0.008;
  const auto p = predict_elements(box_mesh({0, 0, 0}, {1, 1, 1}, 1), h, {.density = 1});
  MESSAGE("cells ", p.cells, ", relative error ", p.elements / exact - 1);
  CHECK(p.elements == doctest::Approx(exact).epsilon(0.05));
}

TEST_CASE("elements may be integrated over in parts, and that is where a prediction begins") {
  const source_field h(1.0, {point_source({0.2, 0.3, 0.4}, 0.1, 0.7, 0.05)});
  const auto mesh = box_mesh({0, 0, 0}, {1, 1, 1}, 3);
  auto known = integrate_elements(mesh, h, 0, 50);
  for (const auto& estimate : integrate_elements(mesh, h, 50, mesh.elements.size()))
    known.push_back(estimate);
  const auto alone = predict_elements(mesh, h), begun = predict_elements(mesh, h, {}, known);
  CHECK(begun.per_element == alone.per_element);
  CHECK(begun.cells == alone.cells);
  for (auto& estimate : known)
    estimate = {0.5, 0}; // so exact that no element is split
  CHECK(predict_elements(mesh, h, {.density = 1}, known).per_element ==
        std::vector<double>(mesh.elements.size(), 0.5));
}

TEST_CASE("sizes too small for any number predict no number, and the prediction ends") {
  const any_sizing h = [](vec3 p) { return distance(p, {0.3, 0.4, 0.6}) < 0.1 ? 1e-300 : 0.2; };
  const auto p = predict_elements(box_mesh({0, 0, 0}, {1, 1, 1}, 4), h);
  CHECK_FALSE(std::isfinite(p.elements));
}

TEST_CASE("the number of cells is bounded and the error reached is told") {
  const source_field h(10.0, {triangle_source({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, 1e-3, 0.01, 1e-4)});
  const auto p = predict_elements(box_mesh({-5, -5, -5}, {10, 10, 10}, 1), h, {.largest_cells = 2000});
  CHECK(p.cells < 2000 * 8);
  CHECK(p.relative_error > 0.05);
}

TEST_CASE("the coarse size is bounded by scale, source radius and box, and never below the size") {
  const source_field h(1.0, {point_source({0, 0, 0}, 0.5, 4.0, 0.1)});
  const box3 domain{{-50, -50, -50}, {50, 50, 50}};
  const coarse_size coarse(h, 30.0, domain);
  CHECK(coarse({0, 0, 0}) == 0.5);
  CHECK(coarse({2, 0, 0}) == 2.0);
  CHECK(coarse({20, 0, 0}) == doctest::Approx(std::sqrt(3.0) * 10));
  CHECK(coarse_size(h, 4.0, domain)({20, 0, 0}) == 4.0);
  CHECK(coarse_size(source_field(1.0, {point_source({}, 0.05, 4.0, 0.1)}), 30.0, domain)({}) == 0.1);
  CHECK_THROWS_AS(coarse_size(h, 0.5, domain), sizing_error);
  CHECK_THROWS_AS(coarse_size(h, 5, box3{}), sizing_error);
}
