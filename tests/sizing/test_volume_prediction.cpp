#include "dovetail/sizing/coarse.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/thin_walls.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/sizing/volume_prediction.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <utility>

using namespace dovetail;

namespace {

/// The surface of a box, two triangles per side, outwards (or inwards when `turned`).
void append_box(simplicial_mesh<2>& mesh, vec3 a, vec3 b, bool turned = false) {
  const auto first = static_cast<local_id>(mesh.points.size());
  for (int k = 0; k < 8; ++k)
    mesh.points.push_back({(k & 1) != 0 ? b.x : a.x, (k & 2) != 0 ? b.y : a.y, (k & 4) != 0 ? b.z : a.z});
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads)
    for (int half = 0; half < 2; ++half) {
      simplex<2> t{first + q[0], first + q[1 + half], first + q[2 + half]};
      if (turned)
        std::swap(t[1], t[2]);
      mesh.elements.push_back(t);
    }
}

simplicial_mesh<2> sphere(double radius, int n) {
  simplicial_mesh<2> mesh;
  const double pi = std::numbers::pi;
  mesh.points.push_back({0, 0, radius});
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j)
      mesh.points.push_back({radius * std::sin(pi * i / n) * std::cos(pi * j / n),
                             radius * std::sin(pi * i / n) * std::sin(pi * j / n),
                             radius * std::cos(pi * i / n)});
  mesh.points.push_back({0, 0, -radius});
  const auto id = [&](int i, int j) {
    return i == 0 ? 0 : i == n ? (n - 1) * 2 * n + 1 : 1 + (i - 1) * 2 * n + j % (2 * n);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      if (i > 0)
        mesh.elements.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
      if (i < n - 1)
        mesh.elements.push_back({id(i, j + 1), id(i + 1, j), id(i + 1, j + 1)});
    }
  return mesh;
}

} // namespace

TEST_CASE("inside a sphere, by radius; its volume by the divergence theorem") {
  const inside_surface inside(sphere(1, 60));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-1.2, 1.2);
  for (int i = 0; i < 20000; ++i) {
    const vec3 p{at(random), at(random), at(random)};
    if (std::abs(norm(p) - 1) > 0.005)
      CHECK(inside(p) == (norm(p) < 1));
  }
  // On the symmetry planes rays pass through vertices and along edges.
  for (int i = 0; i < 300; ++i) {
    const double r = 0.99 * i / 300;
    CHECK(inside({r, 0, 0}));
    CHECK(inside({-r, 0, 0}));
    CHECK(inside({0, r, 0}));
    CHECK_FALSE(inside({-1.1 - r, 0, 0}));
    CHECK_FALSE(inside({-1.1, 0, r}));
    CHECK_FALSE(inside({0, 1.01 + r, 0}));
  }
  CHECK(inside.signed_volume_inside() == doctest::Approx(4.0 / 3 * std::numbers::pi).epsilon(0.01));
}

TEST_CASE("a void in a box is outside") {
  simplicial_mesh<2> mesh;
  append_box(mesh, {0, 0, 0}, {4, 4, 4});
  append_box(mesh, {1, 1, 1}, {2, 3, 3}, true);
  const inside_surface inside(mesh);
  CHECK(inside({0.5, 2, 2}));
  CHECK_FALSE(inside({1.5, 2, 2}));
  CHECK(inside({3, 2, 2}));
  CHECK_FALSE(inside({-1, 2, 2}));
  const auto p = predict_volume_elements(mesh, uniform_size(0.1), {.density = 1});
  CHECK(p.elements == doctest::Approx(60000).epsilon(0.05));
}

TEST_CASE("inside a stack of plates, whichever way it lies") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> at(-0.5, 10.5);
  for (int axis = 0; axis < 3; ++axis) {
    simplicial_mesh<2> plates;
    for (int k = 0; k < 10; ++k) {
      vec3 lower{0, 0, 0}, upper{10, 10, 10};
      lower[axis] = k;
      upper[axis] = k + 0.25;
      append_box(plates, lower, upper);
    }
    const inside_surface inside(plates);
    CHECK(inside.triangle_count() == 120);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
      const vec3 p{at(random), at(random), at(random)};
      const bool in_box = contains({{0, 0, 0}, {10, 10, 10}}, p);
      const bool in_plate = in_box && p[axis] - std::floor(p[axis]) < 0.25;
      CHECK(inside(p) == in_plate);
      hits += in_plate ? 1 : 0;
    }
    CHECK(hits > 3000);
    CHECK(inside.signed_volume_inside() == doctest::Approx(250));
    CHECK(inside.bounds().lower == vec3{0, 0, 0});
    CHECK(inside.bounds().upper[axis] == 9.25);
  }
}

TEST_CASE("no more cells than allowed") {
  simplicial_mesh<2> plate;
  append_box(plate, {0, 0, 0}, {10, 10, 0.02});
  for (vec3& p : plate.points)
    p = {0.8 * p.x - 0.6 * p.z, p.y, 0.6 * p.x + 0.8 * p.z};
  const auto whole = predict_volume_elements(plate, uniform_size(0.01), {.density = 1});
  for (const std::size_t cells : {5000, 10'000, 20'000}) {
    REQUIRE(whole.cells > cells);
    const auto rough =
        predict_volume_elements(plate, uniform_size(0.01), {.density = 1, .largest_cells = cells});
    CHECK(rough.cells <= cells);
    CHECK(rough.relative_error > whole.relative_error);
    CHECK(rough.elements == doctest::Approx(2e6).epsilon(0.1));
  }
}

TEST_CASE("an open surface is refused") {
  simplicial_mesh<2> mesh;
  append_box(mesh, {0, 0, 0}, {1, 1, 1});
  mesh.elements.pop_back();
  CHECK_THROWS_AS(inside_surface{mesh}, geometry_error);
  CHECK_THROWS_AS(inside_surface{simplicial_mesh<2>{}}, geometry_error);
}

TEST_CASE("uniform sizes in a sphere, a thin plate and a slanted one") {
  const auto ball = predict_volume_elements(sphere(3, 40), uniform_size(0.1), {.density = 1});
  MESSAGE("ball: cells ", ball.cells);
  CHECK(ball.elements ==
        doctest::Approx(1000 * inside_surface(sphere(3, 40)).signed_volume_inside()).epsilon(0.05));
  CHECK(ball.relative_error <= 0.05);

  simplicial_mesh<2> plate;
  append_box(plate, {0, 0, 0}, {10, 10, 0.02});
  const auto flat = predict_volume_elements(plate, uniform_size(0.01), {.density = 1});
  MESSAGE("plate: cells ", flat.cells);
  CHECK(flat.elements == doctest::Approx(2e6).epsilon(0.05));

  for (vec3& p : plate.points)
    p = {0.8 * p.x - 0.6 * p.z, p.y, 0.6 * p.x + 0.8 * p.z};
  const auto slanted = predict_volume_elements(plate, uniform_size(0.01), {.density = 1});
  MESSAGE("slanted plate: cells ", slanted.cells);
  CHECK(slanted.elements == doctest::Approx(2e6).epsilon(0.05));
}

TEST_CASE("a tiny source in a large box is not missed, and one outside does not count") {
  simplicial_mesh<2> mesh;
  append_box(mesh, {-53, -47, -51}, {47, 49, 50});
  const source_field h(10.0,
                       {point_source({0, 0, 0}, 1e-3, 0.1, 1e-5), point_source({60, 0, 0}, 1, 2, 1e-5)});
  double exact = (100.0 * 96 * 101) / 1e3;
  const int n = 1000000;
  for (int i = 0; i < n; ++i) {
    const double r = (i + 0.5) * 0.1 / n;
    exact += 4 * std::numbers::pi * r * r * (std::pow(h({r, 0, 0}), -3) - 1e-3) * 0.1 / n;
  }
  const auto p = predict_volume_elements(mesh, h, {.density = 1});
  MESSAGE("cells ", p.cells, ", relative error ", p.elements / exact - 1);
  CHECK(p.elements == doctest::Approx(exact).epsilon(0.05));
}

TEST_CASE("the least size of a cube is asked for only where that of a larger one raises doubts") {
  struct counted {
    double operator()(vec3 p) const { return field(p); }
    double smallest_size_in(const box3& box) const {
      ++*asked;
      return field.smallest_size_in(box);
    }
    source_field field;
    int* asked;
  };
  simplicial_mesh<2> mesh;
  append_box(mesh, {0, 0, 0}, {10, 10, 10});
  const auto predicted = [&](double smallest) {
    int asked = 0;
    const counted h{source_field(1.0, {point_source({3, 3, 3}, 0.5, 2, smallest)}), &asked};
    const auto p = predict_volume_elements(mesh, h, {.density = 1});
    CHECK(p.elements == predict_volume_elements(mesh, h.field, {.density = 1}).elements);
    return std::pair(asked, p.cells);
  };
  const auto [even, cells] = predicted(0.9);
  CHECK(even == 8); // of the largest
  CHECK(cells > 1000);
  const auto [graded, more] = predicted(0.1);
  CHECK(graded > 1);
  CHECK(static_cast<std::size_t>(graded) < more);
}

TEST_CASE("sizes too small for any number predict no number, and the prediction ends") {
  simplicial_mesh<2> mesh;
  append_box(mesh, {0, 0, 0}, {1, 1, 1});
  const auto h = [](vec3 p) { return distance(p, {0.5, 0.5, 0.5}) < 0.2 ? 1e-300 : 0.1; };
  CHECK_FALSE(std::isfinite(predict_volume_elements(mesh, h).elements));
}

TEST_CASE("a field without bounds, half in the body") {
  simplicial_mesh<2> mesh;
  append_box(mesh, {0, 0, 0}, {1, 1, 1});
  const auto h = [](vec3 p) { return distance(p, {0, 0.5, 0.5}) < 0.2 ? 0.005 : 0.1; };
  const double half_ball = 2.0 / 3 * std::numbers::pi * 0.008;
  const auto p = predict_volume_elements(mesh, h, {.density = 1});
  MESSAGE("cells ", p.cells);
  CHECK(p.elements == doctest::Approx(half_ball / 1.25e-7 + (1 - half_ball) * 1e3).epsilon(0.05));
}

TEST_CASE("a sheet of one layer has three elements per prism") {
  constexpr double density = 8;
  const double per_side = 1.5 * elements_per_unit<2>;
  for (const double size : {0.1, 0.05}) {
    for (const double thick : {0.2 * size, 0.5 * size}) {
      simplicial_mesh<2> sheet;
      append_box(sheet, {0, 0, 0}, {1, 1, thick});
      const double wanted = (2 * per_side - density * thick / size) / (size * size);
      CHECK(sizing::elements_in_thin_walls(sheet, uniform_size(size), density) ==
            doctest::Approx(wanted).epsilon(0.05)); // at the rim rays leave by the narrow sides
    }
    simplicial_mesh<2> cube;
    append_box(cube, {0, 0, 0}, {1, 1, 1});
    // Beside the edges a cube is thin for nobody: the rays go straight in.
    CHECK(sizing::elements_in_thin_walls(cube, uniform_size(size), density) == 0);
  }
}

TEST_CASE("a wall between two solids is one for both") {
  constexpr double size = 0.1, thick = 0.03, density = 8;
  simplicial_mesh<2> alone, both;
  append_box(alone, {0, 0, 0}, {1, 1, thick});
  append_box(both, {0, 0, 0}, {1, 1, thick});
  append_box(both, {0, 0, thick}, {1, 1, 2 * thick});
  CHECK(sizing::elements_in_thin_walls(both, uniform_size(size), density) ==
        doctest::Approx(2 * sizing::elements_in_thin_walls(alone, uniform_size(size), density)));
}

TEST_CASE("coarse sizes in a wall are 2.5 times its thickness, and not below the size itself") {
  constexpr double size = 0.02, scale = 6;
  const auto in_walls_of = [&](double thick) {
    simplicial_mesh<2> sheet;
    append_box(sheet, {0, 0, 0}, {1, 1, thick});
    append_box(sheet, {0, 0, 1}, {1, 1, 2}); // a cube beside it, which is no wall
    return sizing::coarse_sizes_in_walls(sheet, uniform_size(size), scale);
  };
  for (const double thick : {0.03, 0.04}) {
    const auto sizes = in_walls_of(thick);
    CHECK(sizes.size() > 4000); // about as many as on the cube
    for (const sized_point& p : sizes) {
      CHECK(p.point.z <= thick);
      if (p.point.z == 0 || p.point.z == thick) // rays from the rim may leave through its corners
        CHECK(p.size == doctest::Approx(2.5 * thick));
    }
  }
  for (const sized_point& p : in_walls_of(0.004))
    CHECK(p.size >= size);
  for (const sized_point& p : in_walls_of(0.06)) // 2.5 times as much is more than the coarse size
    CHECK(p.point.z != 0);
}

TEST_CASE("a coarse size is as small in walls as they say, grows from there, and is never below the size") {
  const box3 domain{{0, 0, 0}, {10, 10, 10}};
  const coarse_size coarse(uniform_size(0.1), 5, domain, {{{5, 5, 5}, 0.2}, {{1, 1, 1}, 0.05}});
  CHECK(coarse({5, 5, 5}) == doctest::Approx(0.2));
  CHECK(coarse({5, 5, 5.1}) == doctest::Approx(0.25));
  CHECK(coarse({1, 1, 1}) == doctest::Approx(0.1));
  CHECK(coarse({9, 9, 9}) == doctest::Approx(0.5));
}

TEST_CASE("a ray meets the nearest triangle in its way, not the one it starts from") {
  simplicial_mesh<2> boxes;
  append_box(boxes, {0, 0, 0}, {1, 1, 1});
  append_box(boxes, {0, 0, 3}, {1, 1, 4});
  const sizing::ray_search rays(boxes);
  CHECK(rays.distance({0.3, 0.4, 0}, {0, 0, 1}, 10) == doctest::Approx(1));
  CHECK(rays.distance({0.3, 0.4, 1}, {0, 0, 1}, 10) == doctest::Approx(2));
  CHECK(rays.distance({0.3, 0.4, 1}, {0, 0, 1}, 1.5) == 1.5);
  CHECK(rays.distance({0.3, 0.4, 4}, {0, 0, 1}, 10) == 10);
  const double slanted = std::sqrt(0.5);
  CHECK(rays.distance({0.3, 0.4, 0}, {slanted, 0, slanted}, 10) == doctest::Approx(0.7 / slanted));
}
