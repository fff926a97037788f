#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "models/model_checks.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace dovetail;

namespace {

constexpr box3 box_of(double half) {
  return {{-half, -half, -half}, {half, half, half}};
}

implicit::metaballs three_balls() {
  return {{{{-0.5, 0, 0}, 0.5}, {{0.5, 0.1, 0}, 0.5}, {{0, 0.6, 0.2}, 0.4}}};
}

double enclosed_volume(const implicit_model& model) {
  const auto& mesh = model.surface().mesh;
  double sum = 0;
  for (const auto& [a, b, c] : mesh.elements)
    sum += signed_volume({}, mesh.points[a], mesh.points[b], mesh.points[c]);
  return sum;
}

/// Points of all faces near their curves, and of all curves.
template <class Visit>
void for_each_surface_point(const implicit_model& model, const Visit& visit) {
  const auto& topology = model.topology();
  for (std::size_t f = 0; f < topology.faces.size(); ++f) {
    const auto face = static_cast<local_id>(f);
    vec2 middle;
    const auto& coedges = topology.faces[f].coedges;
    for (std::size_t k = 0; k < coedges.size(); ++k) {
      const auto& t = topology.curves[coedges[k].curve].t;
      const double t_middle = 0.4 * t[0] + 0.6 * t[1];
      visit(model.curve_point(coedges[k].curve, t_middle), face);
      const vec2 uv = model.curve_uv(face, static_cast<int>(k), t_middle);
      visit(model.face_point(face, uv), face);
      middle = middle + (1.0 / static_cast<double>(coedges.size())) * uv;
    }
  }
}

} // namespace

TEST_CASE("implicit bodies satisfy what is asked of every model") {
  CHECK(testing::faults_of(implicit_model(implicit::sphere{}, box_of(1.5))) == std::vector<std::string>{});
  CHECK(testing::faults_of(implicit_model(implicit::torus{}, box_of(1.5))) == std::vector<std::string>{});
  CHECK(testing::faults_of(implicit_model(three_balls(), box_of(2))) == std::vector<std::string>{});
  const implicit::rounded_box box{.half_widths = {1, 0.8, 0.6}, .rounding = 0.3};
  CHECK(testing::faults_of(implicit_model(box, box_of(1.2))) == std::vector<std::string>{});
}

TEST_CASE("points are on the zero set, not on the triangles") {
  const implicit::torus torus{.large_radius = 1, .small_radius = 0.4};
  const implicit_model model(torus, box_of(1.6), {.resolution = 24});
  for_each_surface_point(model, [&](vec3 p, local_id) { CHECK(std::abs(torus(p)) < 1e-11); });
  for (const auto& vertex : model.topology().vertices)
    CHECK(std::abs(torus(vertex.point)) < 1e-11);
}

TEST_CASE("a function that is no distance, with and without its gradient, gives the same ellipsoid") {
  const auto ellipsoid = [](vec3 p) {
    return std::exp(p.x * p.x + 4 * p.y * p.y + 9 * p.z * p.z) - 2.718281828;
  };
  const auto gradient = [](vec3 p) {
    return std::exp(p.x * p.x + 4 * p.y * p.y + 9 * p.z * p.z) * vec3{2 * p.x, 8 * p.y, 18 * p.z};
  };
  const implicit_model plain(ellipsoid, box_of(1.2));
  const implicit_model with(ellipsoid, box_of(1.2), {.gradient = gradient});
  CHECK(enclosed_volume(plain) == doctest::Approx(4 * std::numbers::pi / 18).epsilon(0.01));
  CHECK(enclosed_volume(with) == doctest::Approx(enclosed_volume(plain)).epsilon(1e-6));
}

TEST_CASE("curvature is that of the surface") {
  const implicit_model ball(implicit::sphere{.radius = 0.5}, box_of(0.8));
  CHECK(ball.face_curvature(0, {0.01, 0.02}) == doctest::Approx(2).epsilon(1e-4));
  const implicit_model ring(implicit::torus{.large_radius = 1, .small_radius = 0.25}, box_of(1.5));
  for (local_id f = 0; f < static_cast<local_id>(ring.topology().faces.size()); ++f)
    CHECK(ring.face_curvature(f, {0, 0}) == doctest::Approx(4).epsilon(1e-3));
}

TEST_CASE("projection finds the nearest point from well away") {
  const implicit_model ball(implicit::sphere{}, box_of(1.5));
  const vec3 on = ball.face_point(0, {0.1, -0.05});
  const vec2 uv = ball.project_to_face(0, 1.3 * on, {0, 0});
  CHECK(distance(ball.face_point(0, uv), on) < 1e-9);
}

TEST_CASE("a void is a second shell of the same solid") {
  const auto hollow = implicit::difference(implicit::sphere{}, implicit::sphere{.radius = 0.5}, 0.05);
  const implicit_model model(hollow, box_of(1.3));
  CHECK(model.topology().solids.size() == 1);
  CHECK(enclosed_volume(model) == doctest::Approx(4 * std::numbers::pi / 3 * (1 - 0.125)).epsilon(0.01));
}

TEST_CASE("united and separate bodies") {
  const implicit::sphere left{{-0.6, 0, 0}, 0.5};
  const implicit::sphere right{{0.6, 0, 0}, 0.5};
  CHECK(implicit_model(implicit::united(left, right, 0.05), box_of(1.3)).topology().solids.size() == 2);
  CHECK(implicit_model(implicit::united(left, right, 0.8), box_of(1.3)).topology().solids.size() == 1);
}

TEST_CASE("what cannot be a body is a typed error that says what to do") {
  const auto message = [](const auto& make) { return testing::refusal_of<geometry_error>(make); };
  const implicit::sphere ball;
  CHECK(message([&] { implicit_model(ball, box_of(0.9)); }).find("larger box") != std::string::npos);
  CHECK(message([&] { implicit_model([](vec3) { return 1.0; }, box_of(1)); }).find("no point") !=
        std::string::npos);
  const auto holed = [](vec3 p) {
    return p.x > 0.2 ? std::numeric_limits<double>::quiet_NaN() : norm(p) - 0.5;
  };
  CHECK(message([&] { implicit_model(holed, box_of(1)); }).find("not finite") != std::string::npos);
  CHECK(message([&] { implicit_model(ball, {{1, 1, 1}, {1, 2, 2}}); }).find("empty") != std::string::npos);
  CHECK(message([&] { implicit_model(ball, box_of(2), {.resolution = 2}); }).find("resolution") !=
        std::string::npos);
}

TEST_CASE("the same function makes the same model") {
  const implicit_model a(three_balls(), box_of(2), {.resolution = 24});
  const implicit_model b(three_balls(), box_of(2), {.resolution = 24});
  CHECK(a.surface().mesh.points == b.surface().mesh.points);
  CHECK(a.surface().mesh.elements == b.surface().mesh.elements);
}
