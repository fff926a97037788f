#include "analytic_surfaces.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/remesh/surfaces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace dovetail;
using namespace dovetail::test;

namespace {

const auto uniform = [](double h) { return [h](vec3) { return h; }; };

vec3 point_of(const patch_boundary& b, const patch_mesh& mesh, local_id v) {
  const auto i = static_cast<std::size_t>(v);
  return i < b.points.size() ? b.points[i] : mesh.inner_points[i - b.points.size()];
}

double area_of(const patch_boundary& b, const patch_mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const vec3 p = point_of(b, mesh, t[0]);
    area += 0.5 * norm(cross(point_of(b, mesh, t[1]) - p, point_of(b, mesh, t[2]) - p));
  }
  return area;
}

double mean_edge(const patch_boundary& b, const patch_mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      sum += distance(point_of(b, mesh, t[i]), point_of(b, mesh, t[(i + 1) % 3]));
  return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

/// What holds for every patch: success, quality, inner points on the surface, every segment in the mesh once.
template <class S>
void check_patch(const S& s, const patch_boundary& b, const patch_mesh& mesh, double least_mean_angle) {
  REQUIRE(mesh.ok());
  CHECK(mesh.summary.get("min_angle_deg") >= 30);
  CHECK(mesh.summary.get("mean_min_angle_deg") >= least_mean_angle);
  for (std::size_t i = 0; i < mesh.inner_uv.size(); ++i)
    CHECK(distance(s.frame(mesh.inner_uv[i]).point, mesh.inner_points[i]) < 1e-12);
  std::map<std::array<local_id, 2>, int> expected;
  for (const auto& [p, q] : b.segments) {
    const local_id x = b.labels[p], y = b.labels[q];
    if (x != y)
      ++expected[{std::min(x, y), std::max(x, y)}];
  }
  for (const auto& [edge, count] : edge_counts(b, mesh)) {
    const auto on_boundary = expected.find(edge);
    CHECK(count == (on_boundary == expected.end() ? 2 : on_boundary->second));
    if (on_boundary != expected.end())
      expected.erase(on_boundary);
  }
  CHECK(expected.empty());
}

patch_boundary square(int n) {
  const remesh::plane_surface s{};
  patch_boundary b;
  add_line(b, s, {0, 0}, {1, 0}, n, 0, 1);
  add_line(b, s, {1, 0}, {1, 1}, n, n, 1);
  add_line(b, s, {1, 1}, {0, 1}, n, 2 * n, 1);
  add_line(b, s, {0, 1}, {0, 0}, n, 3 * n, 1);
  close_loop(b);
  return b;
}

} // namespace

TEST_CASE("a square with a hole is filled exactly, with edges of the given size") {
  const remesh::plane_surface s{};
  patch_boundary b = square(40);
  const std::size_t hole = b.uv.size();
  for (int i = 0; i < 50; ++i) {
    const double a = -2 * pi * i / 50;
    b.uv.push_back({0.5 + 0.2 * std::cos(a), 0.5 + 0.2 * std::sin(a)});
    b.points.push_back(s.frame(b.uv.back()).point);
    b.labels.push_back(1000 + i);
  }
  close_loop(b, hole);
  const auto mesh = remesh::patch_remesher{}(s, b, uniform(1.0 / 40));
  check_patch(s, b, mesh, 52);
  double expected = 1;
  for (std::size_t i = hole; i < b.uv.size(); ++i)
    expected += 0.5 * cross(b.uv[i], b.uv[i + 1 < b.uv.size() ? i + 1 : hole]);
  CHECK(area_of(b, mesh) == doctest::Approx(expected).epsilon(1e-12));
  CHECK(mean_edge(b, mesh) == doctest::Approx(1.0 / 40).epsilon(0.05));
}

TEST_CASE("a graded size is followed from a fine to a coarse side") {
  const remesh::plane_surface s{};
  const auto size = [](vec3 p) { return 0.01 + 0.1 * p.x; };
  patch_boundary b;
  add_line(b, s, {0, 0}, {1, 0}, 24, 0, 1);
  for (int i = 0; i < 24; ++i) { // the points of one side where the size asks for them
    const double x = 0.1 * (std::pow(11, i / 24.0) - 1);
    b.uv[i] = {x, 0};
    b.points[i] = {x, 0, 0};
  }
  add_line(b, s, {1, 0}, {1, 1}, 9, 100, 1);
  add_line(b, s, {1, 1}, {0, 1}, 24, 200, 1);
  for (int i = 0; i < 24; ++i) {
    const double x = 0.1 * (std::pow(11, (24 - i) / 24.0) - 1);
    b.uv[33 + i] = {x, 1};
    b.points[33 + i] = {x, 1, 0};
  }
  add_line(b, s, {0, 1}, {0, 0}, 100, 300, 1);
  close_loop(b);
  const auto mesh = remesh::patch_remesher{}(s, b, size);
  check_patch(s, b, mesh, 48);
  CHECK(mesh.summary.get("mean_relative_length") == doctest::Approx(1).epsilon(0.1));
}

TEST_CASE("a cylinder is closed along its seam") {
  const cylinder s{2};
  for (const int n : {8, 12, 60}) {
    const double h = 4 * pi / n;
    const patch_boundary b = seam_rectangle(s, 2 * pi, 0, 3 * h * n / 8, n, 3 * n / 8, false, false);
    check_patch(s, b, remesh::patch_remesher{}(s, b, uniform(h)), n > 20 ? 50 : 45);
  }
}

TEST_CASE("a long thin cylinder with a coarse circle is not folded") {
  const cylinder s{1};
  const patch_boundary b = seam_rectangle(s, 2 * pi, 0, 60, 8, 76, false, false);
  check_patch(s, b, remesh::patch_remesher{}(s, b, uniform(0.79)), 47);
}

TEST_CASE(
    "a tube far thinner than the size, whose triangles stay bad, costs no more than some tries of each") {
  struct counted_cylinder : cylinder {
    std::size_t* frames;
    surface_frame frame(vec2 uv) const {
      ++*frames;
      return cylinder::frame(uv);
    }
  };
  std::size_t frames = 0;
  const counted_cylinder s{{0.02}, &frames};
  const patch_boundary b = seam_rectangle(s, 2 * pi, 0, 100, 3, 60, false, false);
  const auto mesh = remesh::patch_remesher{}(s, b, uniform(1.7));
  REQUIRE(mesh.triangles.size() > 300);
  CHECK(frames < 8 * mesh.triangles.size());
}

TEST_CASE("a sphere with two poles is closed") {
  const sphere s{};
  for (const int n : {6, 16, 60}) {
    const patch_boundary b = seam_rectangle(s, 2 * pi, -pi / 2, pi / 2, 8, n, true, true);
    const auto mesh = remesh::patch_remesher{}(s, b, uniform(pi / n));
    REQUIRE(mesh.ok());
    CHECK(mesh.summary.get("min_angle_deg") >= 28);
    CHECK(mesh.summary.get("mean_min_angle_deg") >= (n > 20 ? 51 : 46));
    for (const auto& [edge, count] : edge_counts(b, mesh))
      CHECK(count == 2);
    if (n == 60)
      CHECK(area_of(b, mesh) == doctest::Approx(4 * pi).epsilon(2e-3));
  }
}

TEST_CASE("a torus with two seams is closed") {
  const torus s{};
  const int n = 32, m = 14;
  patch_boundary b = seam_rectangle(s, 2 * pi, 0, 2 * pi, n, m, false, false);
  for (int i = 0; i <= n; ++i) // the upper side is the lower one, passed backwards
    b.labels[n + m + i] = (n - i) % n;
  const auto mesh = remesh::patch_remesher{}(s, b, uniform(0.18));
  check_patch(s, b, mesh, 49);
  CHECK(area_of(b, mesh) == doctest::Approx(4 * pi * pi * 0.4).epsilon(2e-2));
}

TEST_CASE("a plane in polar coordinates is filled around its pole") {
  const polar_plane s{};
  const int n = 40, m = 8;
  const patch_boundary b = seam_rectangle(s, 2 * pi, 0, 1, n, m, true, false);
  const auto mesh = remesh::patch_remesher{}(s, b, uniform(0.157));
  REQUIRE(mesh.ok());
  double polygon = 0.5 * n * std::sin(2 * pi / n);
  CHECK(area_of(b, mesh) == doctest::Approx(polygon).epsilon(1e-9));
}

TEST_CASE("a distorted parameter plane gives the same quality") {
  struct stretched {
    surface_frame frame(vec2 uv) const { return {{uv.x * 1e-3, uv.y * 10, 0}, {1e-3, 0, 0}, {0, 10, 0}}; }
    vec2 project(vec3, vec2 seed) const { return seed; }
  };
  patch_boundary b = square(20);
  for (vec2& uv : b.uv)
    uv = {uv.x * 1e3, uv.y * 0.1};
  check_patch(stretched{}, b, remesh::patch_remesher{}(stretched{}, b, uniform(0.05)), 51);
}

TEST_CASE("inner edges between boundary vertices are avoided on demand") {
  const remesh::plane_surface s{};
  patch_boundary b = square(1); // one diagonal
  const auto free = remesh::patch_remesher{}(s, b, uniform(1));
  CHECK(free.triangles.size() == 2);
  b.forbidden_edges = {{0, 2}, {1, 3}};
  const auto kept_apart = remesh::patch_remesher{}(s, b, uniform(1));
  REQUIRE(kept_apart.ok());
  const auto edges = edge_counts(b, kept_apart);
  CHECK_FALSE(edges.contains({0, 2}));
  CHECK_FALSE(edges.contains({1, 3}));
  CHECK(area_of(b, kept_apart) == doctest::Approx(1));
}

TEST_CASE("crossing loops are data, not an exception") {
  const remesh::plane_surface s{};
  patch_boundary b = square(1);
  std::swap(b.uv[1], b.uv[2]);
  std::swap(b.points[1], b.points[2]);
  const auto mesh = remesh::patch_remesher{}(s, b, uniform(0.1));
  CHECK_FALSE(mesh.ok());
  CHECK(mesh.triangles.empty());
  CHECK_FALSE(mesh.crossings.empty());
}

TEST_CASE("the result is the same every time and survives encoding") {
  const torus s{};
  const patch_boundary b = seam_rectangle(s, 2, 0, 2, 10, 5, false, false);
  const auto once = remesh::patch_remesher{}(s, b, uniform(0.1)),
             again = remesh::patch_remesher{}(s, b, uniform(0.1));
  CHECK(once.inner_uv == again.inner_uv);
  CHECK(once.triangles == again.triangles);
  const patch_mesh copy = decoded<patch_mesh>(encoded(once));
  CHECK(copy.inner_uv == once.inner_uv);
  CHECK(copy.inner_points == once.inner_points);
  CHECK(copy.triangles == once.triangles);
  CHECK(copy.summary.counters == once.summary.counters);
}
