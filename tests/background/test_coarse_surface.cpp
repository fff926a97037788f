#include "analytic_models.hpp"
#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/background/surface_faces.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "surface_checks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

using namespace dovetail;
using namespace dovetail::test;

namespace {

const auto uniform = [](double h) { return [h](vec3) { return h; }; };

template <class G>
background::coarse_surface_result mesh(const G& model, double size,
                                       const background::coarse_surface_parameters& parameters = {}) {
  return background::coarse_surface(model, uniform(size), parameters, parallel::serial{},
                                    remesh::patch_remesher{});
}

/// Closed, every edge in two triangles, parameters and hosts right.
template <class G>
void check_surface(const G& model, const surface_mesh& surface) {
  CHECK(open_edges(surface, model.topology()) == 0);
  CHECK(crowded_edges(surface) == 0);
  CHECK(parameter_error(surface, model) < 1e-12);
  REQUIRE(surface.vertex_hosts.size() == surface.mesh.points.size());
  for (const auto& edge : surface.curve_edges) {
    CHECK(edge.t[0] < edge.t[1]);
    for (std::size_t i = 0; i < 2; ++i)
      CHECK(distance(model.curve_point(edge.curve, edge.t[i]), surface.mesh.points[edge.vertices[i]]) <
            1e-12);
  }
}

} // namespace

TEST_CASE("a capped cylinder is closed, outward and near its volume, coarse and fine") {
  const capped_cylinder model(3);
  for (const double size : {5.0, 0.5, 0.1}) {
    const auto result = mesh(model, size);
    check_surface(model, result.surface);
    const double volume = volume_of(result.surface);
    CHECK(volume < 3 * pi);
    CHECK(volume > 3 * pi * (size > 0.4 ? 0.85 : 0.99));
    CHECK(result.summary.get("min_angle_deg") >= 30);
  }
}

TEST_CASE("curvature bounds the edges of a ball whatever the size") {
  const ball model;
  const auto result = mesh(model, 100);
  check_surface(model, result.surface);
  CHECK(volume_of(result.surface) > 0.72 * 4 * pi / 3);
  for (const auto& t : result.surface.mesh.elements)
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(distance(result.surface.mesh.points[t[i]], result.surface.mesh.points[t[(i + 1) % 3]]) < 1.6);
}

TEST_CASE("a pole that is straight but for rounding gets no points beside it") {
  struct rough_ball : ball {
    vec2 curve_uv(local_id f, int k, double t) const {
      vec2 uv = ball::curve_uv(f, k, t);
      if ((k == 0 || k == 2) && t > 0 && t < 2 * pi)
        uv.y *= 1 + 1e-15;
      return uv;
    }
  };
  const rough_ball model;
  for (const double size : {0.5, 0.2, 0.1, 0.05}) {
    const auto result = mesh(model, size);
    check_surface(model, result.surface);
    for (const auto& t : result.surface.mesh.elements)
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(distance(result.surface.mesh.points[t[i]], result.surface.mesh.points[t[(i + 1) % 3]]) >
              0.1 * size);
  }
}

TEST_CASE(
    "the points of a pole are put on a line, on its inner side, where they are on one but for rounding") {
  const vec2 extent{6, 3};
  const double below = 1.5 - 1e-15, above = 1.5 + 1e-15;
  const auto straight = [&](double inside) {
    std::vector<vec2> pole{{6, 1.5}, {4, above}, {2, below}};
    vec2 last{0, above};
    background::detail::straighten_pole(pole, last, {3, inside}, extent);
    pole.push_back(last);
    return pole;
  };
  CHECK(straight(0.5) == std::vector<vec2>{{6, below}, {4, below}, {2, below}, {0, below}});
  CHECK(straight(2.5) == std::vector<vec2>{{6, above}, {4, above}, {2, above}, {0, above}});
  const std::vector<vec2> bent{{6, 1.5}, {4, 1.6}, {2, 1.5}};
  std::vector<vec2> pole = bent;
  vec2 last{0, 1.5};
  background::detail::straighten_pole(pole, last, {3, 0}, extent);
  CHECK(pole == bent);
  std::vector<vec2> upright{{1, 0}, {1 - 1e-15, 2}};
  vec2 top{1 - 1e-15, 3};
  background::detail::straighten_pole(upright, top, {4, 1}, extent);
  CHECK(upright == std::vector<vec2>{{1, 0}, {1, 2}});
  CHECK(top == vec2{1, 3});
}

TEST_CASE("a thin disc stays a surface: two faces never share an edge that is on no curve") {
  for (const double gap : {0.5, 0.05, 0.001}) {
    const thin_disc model(gap);
    const auto result = mesh(model, 10);
    check_surface(model, result.surface);
    CHECK(volume_of(result.surface) > 0.85 * pi * gap);
  }
}

TEST_CASE("every vertex has the host of lowest dimension, every triangle its face") {
  const capped_cylinder model(2);
  const auto surface = mesh(model, 0.4).surface;
  std::set<local_id> faces(surface.mesh.tags.begin(), surface.mesh.tags.end());
  CHECK(faces == std::set<local_id>{0, 1, 2});
  for (std::size_t v = 0; v < surface.mesh.points.size(); ++v) {
    const vec3 p = surface.mesh.points[v];
    const bool on_rim = (p.z == 0 || p.z == 2) && std::abs(p.x * p.x + p.y * p.y - 1) < 1e-12;
    const bool on_seam = p.x == 1 && p.y == 0;
    CHECK(surface.vertex_hosts[v].dimension == (on_rim && on_seam ? 0 : on_rim || on_seam ? 1 : 2));
  }
}

/// The native mesher, and how often it was called for caps, by their height.
struct counted_mesher {
  std::shared_ptr<std::map<double, int>> calls = std::make_shared<std::map<double, int>>();
  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& size) const {
    const box3 box = box_around(boundary.points);
    if (box.lower.z == box.upper.z)
      ++(*calls)[box.lower.z];
    return remesh::patch_remesher{}(surface, boundary, size);
  }
};

TEST_CASE("where a caller wants it finer edges get small, and faces out of reach are not made again") {
  const capped_cylinder model(6);
  const counted_mesher counted;
  background::coarse_surface_parameters parameters;
  std::size_t triangles = 0;
  parameters.finer_at = [&](const background::coarse_surface_result& made) {
    const bool first = std::exchange(triangles, made.surface.mesh.elements.size()) == 0;
    return first ? std::vector<size_ball>{{{0, 0, 6}, 0.2, 0.05}} : std::vector<size_ball>{};
  };
  const auto refined =
      background::coarse_surface(model, uniform(0.7), parameters, parallel::serial{}, counted);
  CHECK(refined.summary.get("refinement_rounds") == 1);
  CHECK(refined.surface.mesh.elements.size() == triangles);
  CHECK(refined.bounds.back().size == 0.05);
  CHECK(counted.calls->at(0) == 1);
  CHECK(counted.calls->at(6) == 2);
  check_surface(model, refined.surface);
  double shortest = 1e300;
  for (const auto& t : refined.surface.mesh.elements)
    shortest =
        std::min(shortest, distance(refined.surface.mesh.points[t[0]], refined.surface.mesh.points[t[1]]));
  CHECK(shortest < 0.08);
}

TEST_CASE("executors give the same mesh") {
  const capped_cylinder model(3);
  const auto one =
      background::coarse_surface(model, uniform(0.3), {}, parallel::serial{}, remesh::patch_remesher{});
  const auto many =
      background::coarse_surface(model, uniform(0.3), {}, parallel::threads{2}, remesh::patch_remesher{});
  CHECK(one.surface.mesh.points == many.surface.mesh.points);
  CHECK(one.surface.mesh.elements == many.surface.mesh.elements);
}

TEST_CASE("a face whose boundary crosses itself is named in the error") {
  struct twisted : capped_cylinder {
    using capped_cylinder::capped_cylinder;
    vec2 curve_uv(local_id f, int k, double t) const {
      return f == 2 ? vec2{std::sin(t), std::sin(2 * t)} : capped_cylinder::curve_uv(f, k, t);
    }
  };
  const twisted model(1);
  background::coarse_surface_parameters parameters;
  parameters.rounds = 3;
  CHECK_THROWS_WITH_AS(mesh(model, 0.5, parameters), doctest::Contains("face 2 (above)"), geometry_error);
}
