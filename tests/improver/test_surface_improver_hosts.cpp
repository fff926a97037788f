/// @file
/// Triangles on curved hosts: vertices stay on them, and nothing that is fixed moves.
#include "dovetail/improver/native.hpp"
#include "dovetail/improver/native_by.hpp"
#include "surface_checks.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace surface_checks;
using dovetail::host_point;
using dovetail::surface_host;
using dovetail::improvement::native;

namespace {

const surface_host unit_sphere{[](local_id, vec3 p, vec2) {
  return host_point{normalized(p), normalized(p), {}};
}};
const surface_host unit_cylinder{[](local_id, vec3 p, vec2) {
  const vec3 n = dovetail::normalized({p.x, p.y, 0});
  return host_point{{n.x, n.y, p.z}, n, {}};
}};

vec3 on_cylinder(double x, double y) {
  return {std::cos(3 * x), std::sin(3 * x), 3 * y};
}

/// Every triangle faces outwards of a surface around the origin or the z axis.
std::size_t facing_inwards(const triangle_mesh& mesh, const surface_host& host) {
  return static_cast<std::size_t>(
      std::count_if(mesh.elements.begin(), mesh.elements.end(), [&](const simplex<2>& triangle) {
        const auto p = dovetail::corners(std::span(mesh.points), triangle);
        const vec3 n = host.project(0, (p[0] + p[1] + p[2]) / 3, {}).normal;
        return dot(cross(p[1] - p[0], p[2] - p[0]), n) <= 0;
      }));
}

} // namespace

TEST_CASE("on a sphere and on a cylinder") {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    CAPTURE(seed);
    const bool is_ball = seed % 2 == 0;
    const auto& host = is_ball ? unit_sphere : unit_cylinder;
    const auto mesh = is_ball ? closed_cube(9, 0.3, seed, true)
                              : bent(dovetail_test::jittered_squares(24, 0.3, seed, 0), on_cylinder);
    REQUIRE(facing_inwards(mesh, host) == 0);
    auto result = mesh;
    native::fine()(result, {}, {}, host);
    check_change(mesh, result);
    CHECK(facing_inwards(result, host) == 0);
    std::size_t moved = 0;
    for (std::size_t v = 0; v < result.points.size(); ++v) {
      const vec3 p = result.points[v];
      CHECK(distance(host.project(0, p, {}).point, p) < 1e-14);
      moved += v >= mesh.points.size() || !(p == mesh.points[v]);
    }
    CHECK(moved > mesh.points.size() / 4);
    CHECK(dovetail::measure_quality(mesh).min_dihedrals.below(30) > 50);
    CHECK(dovetail::measure_quality(result).min_dihedrals.below(30) == 0);
  }
}

TEST_CASE("a tag chooses the face, and its parameters are carried along") {
  // Two halves of a bent sheet as faces 0 and 1, whose parameters differ by a shift.
  auto mesh = bent(dovetail_test::jittered_squares(20, 0.3, 5, 0), on_cylinder);
  surface_host host;
  const auto at = [](local_id face, vec2 uv) {
    const double angle = uv.x - 10 * face;
    return host_point{{std::cos(angle), std::sin(angle), uv.y}, {std::cos(angle), std::sin(angle), 0}, uv};
  };
  host.evaluate = at;
  host.project = [at](local_id face, vec3 p, vec2 near) {
    CHECK(std::abs(near.x - 10 * face - 1.5) < 1.6); // the seed belongs to this face
    return at(face, {std::atan2(p.y, p.x) + 10 * face, p.z});
  };
  for (const auto& triangle : mesh.elements) {
    const auto p = dovetail::corners(std::span(mesh.points), triangle);
    const local_id face = p[0].z + p[1].z + p[2].z < 4.5 ? 0 : 1;
    mesh.tags.push_back(face);
    std::array<vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k)
      uv[k] = {std::atan2(p[k].y, p[k].x) + 10 * face, p[k].z};
    host.corner_uv.push_back(uv);
  }
  auto result = mesh;
  std::vector<std::array<vec2, 3>> corner_uv;
  dovetail::improvement::improve_surface<dovetail::improvement::native_operations>(native::fine(), result, {},
                                                                                   {}, host, &corner_uv);
  check_change(mesh, result);
  REQUIRE(corner_uv.size() == result.elements.size());
  for (std::size_t t = 0; t < corner_uv.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(distance(at(result.tags[t], corner_uv[t][k]).point, result.points[result.elements[t][k]]) <
            1e-12);
}

TEST_CASE("a host that fails somewhere is left alone there") {
  surface_host host = unit_sphere;
  host.project = [](local_id, vec3 p, vec2) {
    return p.z > 0.3 ? host_point{p, {}, {}} : host_point{normalized(p), normalized(p), {}};
  };
  const auto mesh = closed_cube(9, 0.3, 3, true);
  auto result = mesh;
  native::fast()(result, {}, {}, host);
  check_change(mesh, result);
  for (const vec3& p : result.points)
    CHECK(norm(p) == doctest::Approx(1).epsilon(1e-14));
}
