#include "discrete_shapes.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "model_checks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

discrete_model model_of(const triangle_soup& soup, const discrete_options& options = {}) {
  return discrete_model(repaired(soup), options);
}

void check_model(const discrete_model& model) {
  for (const std::string& fault : faults_of(model))
    FAIL_CHECK(fault);
}

std::size_t features(const discrete_model& model) {
  std::size_t count = 0;
  for (const auto& curve : model.topology().curves)
    count += curve.name != "chart border" ? 1 : 0;
  return count;
}

/// Every point of a face lies on the surface, under its normal.
double worst_lift(const discrete_model& model) {
  const auto& s = model.surface();
  double worst = 0;
  for (std::size_t t = 0; t < s.mesh.elements.size(); ++t) {
    vec3 p{};
    for (const local_id v : s.mesh.elements[t])
      p += s.mesh.points[v] / 3;
    const local_id f = s.chart_of[t];
    const vec2 uv = s.frames[f].flat(p);
    worst = std::max(worst, distance(model.face_point(f, uv), p));
    worst = std::max(worst, norm(model.project_to_face(f, p, {}) - uv));
  }
  return worst;
}

/// A coarse sphere of uneven triangles.
triangle_soup uneven_sphere(int n, double seed) {
  triangle_soup soup = sphere_soup({0, 0, 0}, 1, n);
  for (vec3& p : soup.points)
    p = normalized(p + (0.35 / n) * vec3{std::sin(37.1 * p.x + 11.3 * p.y + seed),
                                         std::sin(29.7 * p.y + 17.9 * p.z + 2 * seed),
                                         std::sin(41.3 * p.z + 13.7 * p.x + 3 * seed)});
  return soup;
}

/// How far a point is from the triangles of a model.
double away_from(const simplicial_mesh<2>& triangles, vec3 p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : triangles.elements) {
    const auto [a, b, c] = corners(std::span(triangles.points), t);
    const auto w = nearest_on_triangle(a, b, c, p);
    nearest = std::min(nearest, distance(w[0] * a + w[1] * b + w[2] * c, p));
  }
  return nearest;
}

/// Smallest angle, in degrees, between consecutive coedges of a face, in its parameter plane.
double smallest_corner(const discrete_model& model) {
  const auto& topology = model.topology();
  double smallest = 360;
  for (std::size_t f = 0; f < topology.faces.size(); ++f)
    for (const auto& loop : topology.faces[f].loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto end_of = [&](const geometry_topology::coedge& e, bool at_start, double away) {
          const auto& curve = topology.curves[e.curve];
          const double length = std::min(away, curve.t[1] / 3);
          const vec3 p = model.curve_point(e.curve, at_start != e.reversed ? length : curve.t[1] - length);
          return model.surface().frames[f].flat(p);
        };
        const vec2 v = end_of(loop[k], false, 0);
        const vec2 in = end_of(loop[k], false, 1e-4) - v;
        const vec2 out = end_of(loop[(k + 1) % loop.size()], true, 1e-4) - v;
        const double angle = std::atan2(cross(out, in), dot(out, in)) * 180 / std::numbers::pi;
        smallest = std::min(smallest, angle < 0 ? angle + 360 : angle);
      }
  return smallest;
}

} // namespace

TEST_CASE("a cube has six faces, twelve curves and eight vertices") {
  for (const int n : {1, 4}) {
    const auto model = model_of(box_soup({0, 0, 0}, {1, 2, 3}, n));
    CHECK(model.topology().faces.size() == 6);
    CHECK(model.topology().curves.size() == 12);
    CHECK(model.topology().vertices.size() == 8);
    CHECK(model.topology().solids.size() == 1);
    check_model(model);
    CHECK(worst_lift(model) < 1e-12);
  }
}

TEST_CASE("a smooth sphere is cut into a few charts without features") {
  const auto model = model_of(sphere_soup({1, 2, 3}, 2, 12));
  CHECK(features(model) == 0);
  CHECK(model.topology().faces.size() >= 6);
  CHECK(model.topology().faces.size() <= 16);
  check_model(model);
  CHECK(worst_lift(model) < 1e-9);
  for (std::size_t f = 0; f < model.topology().faces.size(); ++f) {
    const auto face = static_cast<local_id>(f);
    const vec3 origin = model.surface().frames[f].origin;
    const vec2 foot = model.project_to_face(face, origin, {});
    const vec2 uv{foot.x + 0.0131, foot.y + 0.0057}; // off vertices and edges
    const surface_frame frame = model.face_frame(face, uv);
    const vec3 outwards = normalized(model.face_point(face, uv) - vec3{1, 2, 3});
    CHECK(dot(normalized(cross(frame.du, frame.dv)), outwards) > 0.9);
    CHECK(distance(model.face_point(face, uv), {1, 2, 3}) == doctest::Approx(2).epsilon(0.02));
    CHECK(model.face_curvature(face, uv) == doctest::Approx(0.5).epsilon(0.3));
    // The frame is the derivative of the point, inside a triangle.
    const double h = 1e-6;
    const vec3 moved = model.face_point(face, {uv.x + h, uv.y});
    CHECK(norm(moved - frame.point - h * frame.du) < 1e-2 * h + 1e-9);
  }
}

TEST_CASE("charts end smoothly: their borders on a sphere are about as long as arcs") {
  const auto model = model_of(sphere_soup({0, 0, 0}, 1, 16));
  for (std::size_t c = 0; c < model.topology().curves.size(); ++c) {
    const auto& curve = model.topology().curves[c];
    double longest_turn = 0;
    for (int i = 1; i < 40; ++i) {
      const double t = curve.t[1] * i / 40;
      longest_turn = std::max(
          longest_turn,
          angle_between(model.curve_frame(static_cast<local_id>(c), t).derivative,
                        model.curve_frame(static_cast<local_id>(c), curve.t[1] * (i - 1) / 40).derivative));
    }
    CHECK(longest_turn < 1.2);
  }
}

TEST_CASE("a torus, whose charts have no natural start, passes all checks") {
  const auto model = model_of(torus_soup(3, 1, 60, 24));
  CHECK(features(model) == 0);
  check_model(model);
  CHECK(worst_lift(model) < 1e-9);
}

TEST_CASE("the charts of a coarse, uneven surface go through its points") {
  struct uneven {
    int n;
    double seed;
  };
  for (const uneven& of :
       {uneven{5, 2}, uneven{5, 6}, uneven{5, 11}, uneven{6, 8}, uneven{6, 9}, uneven{8, 1}}) {
    CAPTURE(of.n);
    CAPTURE(of.seed);
    const auto soup = uneven_sphere(of.n, of.seed);
    const auto model = model_of(soup);
    for (const vec3 p : soup.points)
      CHECK(away_from(model.surface().mesh, p) < 1e-9);
  }
}

TEST_CASE("charts of smooth surfaces have no thin corners") {
  CHECK(smallest_corner(model_of(box_soup({0, 0, 0}, {1, 1, 1}, 2))) == doctest::Approx(90));
  for (const int n : {10, 16, 25})
    CHECK(smallest_corner(model_of(sphere_soup({0, 0, 0}, 1, n))) > 20);
  CHECK(smallest_corner(model_of(torus_soup(3, 1, 60, 24))) > 20);
}

TEST_CASE("a cylinder has two closed feature curves") {
  triangle_soup soup;
  const int n = 48;
  for (int i = 0; i < n; ++i)
    for (const double z : {0.0, 3.0})
      soup.points.push_back(
          {std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n), z});
  soup.points.push_back({0, 0, 0});
  soup.points.push_back({0, 0, 3});
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % n);
    for (const auto& t : {simplex<2>{a, b, b + 1}, simplex<2>{a, b + 1, a + 1}, simplex<2>{b, a, 2 * n},
                          simplex<2>{a + 1, b + 1, 2 * n + 1}}) {
      soup.triangles.push_back(t);
      soup.groups.push_back(no_id);
    }
  }
  const auto model = model_of(soup);
  CHECK(features(model) >= 2);
  CHECK(features(model) <= 10);
  CHECK(model.topology().faces.size() <= 8);
  check_model(model);
  double length = 0;
  for (const auto& curve : model.topology().curves)
    if (curve.name != "chart border")
      length += curve.t[1];
  CHECK(length == doctest::Approx(2 * 2 * std::numbers::pi).epsilon(0.01));
}

TEST_CASE("several bodies and voids are solids with all their faces") {
  triangle_soup soup;
  append(soup, box_soup({0, 0, 0}, {10, 10, 10}));
  append(soup, sphere_soup({5, 5, 5}, 3, 6));
  append(soup, box_soup({20, 0, 0}, {21, 1, 1}));
  const auto model = model_of(soup);
  CHECK(model.topology().solids.size() == 2);
  check_model(model);
  for (std::size_t f = 0; f < model.topology().faces.size(); ++f) {
    const auto& frame = model.surface().frames[f];
    if (distance(frame.origin, {5, 5, 5}) < 3.5) { // of the void: its normal points into the void
      CHECK(dot(frame.n, frame.origin - vec3{5, 5, 5}) < 0);
      CHECK(model.topology().faces[f].solids[0] == 0);
    }
  }
}

TEST_CASE("named solids of a file become groups, with curves between them") {
  auto soup = box_soup({0, 0, 0}, {1, 1, 1}, 2);
  soup.group_names = {"inlet", "wall"};
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    soup.groups[t] = t < 4 ? 0 : 1; // half of one side
  const auto model = model_of(soup);
  CHECK(model.topology().faces.size() == 7);
  int inlets = 0;
  for (const auto& face : model.topology().faces)
    inlets += face.group == "inlet" ? 1 : 0;
  CHECK(inlets == 1);
  check_model(model);
}

TEST_CASE("an STL file is a model, and errors name the file") {
  const scratch_folder folder("test_discrete_model");
  write_binary_stl(folder / "ball.stl", sphere_soup({0, 0, 0}, 1, 8));
  const auto model = read_discrete_model(folder / "ball.stl");
  check_model(model);
  auto open = sphere_soup({0, 0, 0}, 1, 8);
  open.triangles.resize(100);
  write_text_stl(folder / "open.stl", open);
  CHECK_THROWS_WITH_AS(read_discrete_model(folder / "open.stl"),
                       doctest::Contains("open.stl: the surface is open"), geometry_error);
}
