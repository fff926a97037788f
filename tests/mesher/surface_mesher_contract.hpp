/// @file
/// What every surface mesher must do, on planes and cylinders; each model's test calls it.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/mesher/surface_checks.hpp"
#include "dovetail/remesh/concepts.hpp"
#include "remesh/analytic_surfaces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace contract {

using namespace dovetail;

inline void add_loop(patch_boundary& b, const auto& surface, std::vector<vec2> corners, double h) {
  const std::size_t first = b.uv.size();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const vec2 p = corners[k], q = corners[(k + 1) % corners.size()];
    test::add_line(b, surface, p, q, std::max(1, static_cast<int>(std::lround(norm(q - p) / h))),
                   static_cast<local_id>(b.uv.size()), 1);
  }
  test::close_loop(b, first);
}

/// A unit square of parameters with a square hole.
inline patch_boundary square_with_hole(const auto& surface, double h) {
  patch_boundary b;
  add_loop(b, surface, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, h);
  add_loop(b, surface, {{0.3, 0.3}, {0.3, 0.6}, {0.6, 0.6}, {0.6, 0.3}}, h);
  return b;
}

/// The semantics of the concept, on a domain of known area in the parameter plane.
inline void require_filled(const auto& surface, const patch_boundary& b, const patch_mesh& mesh, double area,
                           double h) {
  REQUIRE(mesh.ok());
  REQUIRE(mesh.inner_uv.size() == mesh.inner_points.size());
  std::vector<vec2> uv = b.uv;
  uv.insert(uv.end(), mesh.inner_uv.begin(), mesh.inner_uv.end());
  std::vector<vec3> points = b.points;
  points.insert(points.end(), mesh.inner_points.begin(), mesh.inner_points.end());
  for (std::size_t k = 0; k < mesh.inner_uv.size(); ++k)
    REQUIRE(mesh.inner_points[k] == surface.frame(mesh.inner_uv[k]).point);

  double filled = 0;
  std::map<std::array<local_id, 2>, int> passed;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return uv[t[k]]; };
    REQUIRE(orient2d(at(0), at(1), at(2)) > 0);
    filled += 0.5 * cross(at(1) - at(0), at(2) - at(0));
    for (std::size_t k = 0; k < 3; ++k)
      ++passed[{t[k], t[(k + 1) % 3]}];
  }
  CHECK(filled == doctest::Approx(area).epsilon(1e-9));
  const std::set<std::array<local_id, 2>> lines(b.segments.begin(), b.segments.end());
  for (const auto& segment : lines)
    REQUIRE(passed[segment] == 1);
  double length = 0;
  std::size_t edges = 0;
  for (const auto& [edge, times] : passed) {
    if (times == 0)
      continue;
    REQUIRE(times == 1);
    const bool shared = passed.contains({edge[1], edge[0]});
    REQUIRE(shared != lines.contains(edge));
    if (edge[0] < edge[1] || !shared) {
      length += distance(points[edge[0]], points[edge[1]]);
      ++edges;
    }
  }
  CHECK(length / static_cast<double>(edges) == doctest::Approx(h).epsilon(0.1));
}

template <class M>
void check_surface_mesher(const M& mesher) {
  static_assert(surface_mesher<M>);
  const double h = 0.04;
  const any_sizing uniform = [h](vec3) { return h; };
  const remesh::plane_surface at{{100, 2, 3}};
  const any_surface plane = any_surface::view_of(at);
  const auto flat = square_with_hole(plane, h);
  const auto mesh = mesher(plane, flat, uniform);
  require_filled(plane, flat, mesh, 0.91, h);
  const auto again = mesher(plane, flat, uniform);
  CHECK(mesh.inner_uv == again.inner_uv);
  CHECK(mesh.triangles == again.triangles);

  const test::cylinder unit{1};
  const any_surface cylinder = any_surface::view_of(unit);
  const auto bent = square_with_hole(cylinder, h);
  require_filled(cylinder, bent, mesher(cylinder, bent, uniform), 0.91, h);

  auto crossing = flat;
  crossing.uv[3].y = -0.5; // outwards, through nothing: still a loop
  std::swap(crossing.uv[10], crossing.uv[40]);
  const auto none = mesher(plane, crossing, uniform);
  CHECK_FALSE(none.crossings.empty());
  CHECK(none.triangles.empty());

  auto backwards = flat;
  for (auto& [a, b] : backwards.segments)
    std::swap(a, b);
  const auto inverted = mesher(plane, backwards, uniform);
  CHECK_FALSE(inverted.misplaced.empty());
  CHECK(inverted.triangles.empty());
  CHECK_THROWS_AS(mesher(plane, flat, [](vec3) { return std::nan(""); }), sizing_error);
}

inline any_surface plane_at_run_time() {
  const remesh::plane_surface plane{};
  return {[plane](vec2 uv) { return plane.frame(uv); },
          [plane](vec3 p, vec2 seed) { return plane.project(p, seed); }, plane};
}

inline mesher_input<2> piece_of_plane(patch_boundary b) {
  mesher_input<2> input;
  input.boundary.points = b.points;
  input.boundary.elements.assign(b.segments.begin(), b.segments.end());
  input.regions.push_back({std::move(b), plane_at_run_time(), 0});
  return input;
}

/// What declares that it may run in several threads gives the same mesh in each.
template <boundary_keeping_mesher<2> M>
void check_threads(const M& mesher, const mesher_input<2>& input, const any_sizing& size) {
  if constexpr (M::traits.thread_safe) {
    const auto expected = mesher(input, size).mesh;
    std::array<bool, 4> same{};
    std::vector<std::thread> workers;
    for (bool& mine : same)
      workers.emplace_back([&] {
        mine = true;
        for (int turn = 0; turn < 5; ++turn) {
          const auto made = mesher(input, size).mesh;
          mine = mine && made.points == expected.points && made.elements == expected.elements;
        }
      });
    for (auto& worker : workers)
      worker.join();
    CHECK(same == std::array<bool, 4>{true, true, true, true});
  }
}

/// A slit, which only pieces' regions have, and lines that cross.
template <boundary_keeping_mesher<2> M>
void check_pieces(const M& mesher) {
  const remesh::plane_surface plane{};
  const double h = 0.05;
  const any_sizing uniform = [h](vec3) { return h; };
  patch_boundary b;
  add_loop(b, plane, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, h);
  const auto first = static_cast<local_id>(b.uv.size());
  test::add_line(b, plane, {0.3, 0.5}, {0.8, 0.5}, 10, first, 1);
  for (local_id i = first; i < first + 9; ++i)
    b.segments.insert(b.segments.end(), {{i, i + 1}, {i + 1, i}});
  auto input = piece_of_plane(b);
  check_mesher_result(input, mesher(input, uniform).mesh);
  check_threads(mesher, input, uniform);
  std::swap(input.regions[0].boundary.uv[5], input.regions[0].boundary.uv[30]);
  CHECK_THROWS_AS(mesher(input, uniform), mesher_error);
}

/// A strip of one row, where every inner edge joins boundary points.
template <boundary_keeping_mesher<2> M>
void check_forbidden_chords(const M& mesher) {
  patch_boundary b;
  const double h = 0.05;
  add_loop(b, remesh::plane_surface{}, {{0, 0}, {1, 0}, {1, h}, {0, h}}, h);
  auto input = piece_of_plane(b);
  const any_sizing uniform = [h](vec3) { return h; };
  const std::size_t triangles = mesher(input, uniform).mesh.elements.size();
  const auto is_odd = [](local_id a, local_id c) { return (a + c) % 4 == 1; };
  input.regions.front().forbids = is_odd;
  const auto result = mesher(input, uniform);
  check_mesher_result(input, result.mesh);
  CHECK(result.mesh.elements.size() > triangles);
  const auto frozen = static_cast<local_id>(b.uv.size());
  std::set<std::array<local_id, 2>> lines;
  for (const auto& [from, to] : b.segments)
    lines.insert({std::min(from, to), std::max(from, to)});
  for (const auto& t : result.mesh.elements)
    for (std::size_t k = 0; k < 3; ++k) {
      const local_id from = std::min(t[k], t[(k + 1) % 3]), to = std::max(t[k], t[(k + 1) % 3]);
      CHECK((to >= frozen || lines.contains({from, to}) || !is_odd(from, to)));
    }
}

} // namespace contract
