#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/remesh/triangle_surface.hpp"

#include <doctest/doctest.h>

#include <numbers>

using namespace dovetail;

namespace {

struct curved_face {
  std::array<vec3, 3> corners{vec3{0, 0, 0}, vec3{1, 0, 0}, vec3{0.3, 0.9, 0.2}};
  std::array<std::vector<vec3>, 3> sides;
  std::array<std::vector<local_id>, 3> labels;
};

/// A face with n segments per side whose side 0 bulges out of plane and side 2 in plane, by `height`.
curved_face make_face(int n, double height) {
  curved_face face;
  local_id label = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    for (int m = 0; m <= n; ++m) {
      const double s = static_cast<double>(m) / n;
      vec3 p = (1 - s) * face.corners[j] + s * face.corners[k];
      const double bulge = height * 4 * s * (1 - s);
      if (m > 0 && m < n && i == 0)
        p += bulge * vec3{0, 0, 1};
      if (m > 0 && m < n && i == 2)
        p += bulge * vec3{0, -1, 0};
      face.sides[i].push_back(p);
      face.labels[i].push_back(m == 0   ? static_cast<local_id>(j)
                               : m == n ? static_cast<local_id>(k)
                                        : label++);
    }
  }
  return face;
}

} // namespace

TEST_CASE("the surface passes through every point of the curved sides") {
  const curved_face face = make_face(9, 0.15);
  const remesh::triangle_surface surface(face.corners, face.sides);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < face.sides[i].size(); ++j)
      CHECK(distance(surface.frame(surface.side_uv(i, j)).point, face.sides[i][j]) < 1e-14);
}

TEST_CASE("derivatives agree with differences and projection inverts evaluation") {
  const curved_face face = make_face(7, 0.2);
  const remesh::triangle_surface surface(face.corners, face.sides);
  for (const vec2 uv : {vec2{0.4, 0.3}, vec2{0.7, 0.1}, vec2{0.35, 0.7}, vec2{0.1, 0.05}}) {
    constexpr double d = 1e-6;
    const surface_frame f = surface.frame(uv);
    const vec3 du = (surface.frame({uv.x + d, uv.y}).point - surface.frame({uv.x - d, uv.y}).point) / (2 * d);
    const vec3 dv = (surface.frame({uv.x, uv.y + d}).point - surface.frame({uv.x, uv.y - d}).point) / (2 * d);
    CHECK(distance(f.du, du) < 1e-6);
    CHECK(distance(f.dv, dv) < 1e-6);
    CHECK(norm(surface.project(f.point, uv + vec2{0.05, -0.03}) - uv) < 1e-9);
  }
}

TEST_CASE("a curved face is remeshed without folds and keeps its sides") {
  for (const double height : {0.0, 0.05, 0.25}) {
    const curved_face face = make_face(20, height);
    const remesh::triangle_surface surface(face.corners, face.sides);
    const patch_boundary boundary = remesh::triangle_boundary(surface, face.sides, face.labels);
    const auto mesh = remesh::patch_remesher{}(surface, boundary, [](vec3) { return 0.05; });
    REQUIRE(mesh.ok());
    CHECK(mesh.summary.get("min_angle_deg") >= 30);
    CHECK(mesh.summary.get("mean_min_angle_deg") >= 50);
    CHECK(boundary.segments.size() == 60);
  }
}

TEST_CASE("straight sides give the plane of the triangle") {
  const std::array<vec3, 3> corners{vec3{1, 2, 3}, vec3{2, 2, 4}, vec3{1, 4, 3}};
  const remesh::triangle_surface surface(corners, {});
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(distance(surface.frame(surface.corner_uv(i)).point, corners[i]) < 1e-14);
  const vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
  CHECK(distance(surface.frame(surface.project(middle, {0, 0})).point, middle) < 1e-14);
}
