/// @file
/// What every boundary-keeping volume mesher must do; each model's test includes this and calls it.
#pragma once

#include "dovetail/distributed/processes.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "mesher/shapes.hpp"
#include "pipeline/solid_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace contract {

using namespace dovetail;
using dovetail::testing::volume_of;

inline std::vector<std::array<local_id, 2>> unique_edges(const simplicial_mesh<3>& mesh) {
  std::vector<std::array<local_id, 2>> edges;
  for (const auto& element : mesh.elements)
    for (const auto& r : numbering::ridges<3>) {
      const local_id a = element[r[0]];
      const local_id b = element[r[1]];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

inline double mean_edge(const simplicial_mesh<3>& mesh) {
  const auto edges = unique_edges(mesh);
  double sum = 0;
  for (const auto& [a, b] : edges)
    sum += distance(mesh.points[a], mesh.points[b]);
  return sum / static_cast<double>(edges.size());
}

/// The oriented boundary triangles of a mesh, each rotated to start at its lowest vertex, sorted.
inline std::vector<simplex<2>> rotated(std::vector<simplex<2>> triangles) {
  for (auto& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}
inline std::vector<simplex<2>> hull(const simplicial_mesh<3>& mesh) {
  const auto sides = build_sides(mesh);
  std::vector<simplex<2>> triangles;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      triangles.push_back(sides.vertices[s]);
  return rotated(triangles);
}

/// The promises of the concept, checked independently of the library's own checks.
inline void require_contract(const mesher_input<3>& input, const simplicial_mesh<3>& mesh) {
  REQUIRE(mesh.points.size() >= input.boundary.points.size());
  CHECK(std::equal(input.boundary.points.begin(), input.boundary.points.end(), mesh.points.begin()));
  const auto faults = check_validity(mesh);
  CHECK_MESSAGE(faults.valid(), faults.text());
  CHECK(hull(mesh) == rotated(input.boundary.elements));
  CHECK(volume_of(mesh) == doctest::Approx(enclosed_volume(input.boundary.points, input.boundary.elements)));
  CHECK(mesh.tags == std::vector<local_id>(mesh.elements.size(), input.material));
}

template <class M>
simplicial_mesh<3> mesh_and_check(const M& mesher, const shapes::surface& boundary, const any_sizing& size) {
  const mesher_input<3> input{boundary, 5};
  auto result = mesher(input, size);
  require_contract(input, result.mesh);
  CHECK(result.summary.get("elements") == static_cast<double>(result.mesh.elements.size()));
  return result.mesh;
}

struct named_shape {
  std::string name;
  shapes::surface boundary;
  double size; ///< one that suits it
};

/// Shapes that every mesher must accept.
inline std::vector<named_shape> manifold_shapes() {
  auto one_void = shapes::cube(8);
  shapes::append(one_void, shapes::sphere(2, 0.3, {0.5, 0.5, 0.5}), true);
  auto two_voids = shapes::cube(8);
  shapes::append(two_voids, shapes::sphere(2, 0.2, {0.25, 0.5, 0.5}), true);
  shapes::append(two_voids, shapes::cube(3, 0.3, {0.6, 0.35, 0.35}), true);
  // A solid inside a void inside a solid: two pieces of material.
  auto nested = shapes::sphere(3, 1);
  shapes::append(nested, shapes::sphere(2, 0.7), true);
  shapes::append(nested, shapes::sphere(1, 0.3), false);
  const auto l_shape = shapes::cells(
      shapes::block({0, 0, 0}, {8, 8, 4}, [](int x, int y, int) { return x < 4 || y < 4; }), {0.1, 0.1, 0.1});
  const auto slab = shapes::cells(shapes::block({0, 0, 0}, {10, 10, 1}), {0.1, 0.1, 1e-4});
  return {{"cube", shapes::cube(8), 0.14},
          {"cube far from the origin", shapes::cube(6, 1e-3, {1e3, -1e3, 500}), 2e-4},
          {"sphere", shapes::sphere(3), 0.15},
          {"torus", shapes::torus(12), 0.2},
          {"L-shape", l_shape, 0.12},
          {"thin slab", slab, 0.1},
          {"cube with a void", one_void, 0.14},
          {"cube with two voids", two_voids, 0.14},
          {"nested shells", nested, 0.25}};
}

template <class M>
void check_shapes(const M& mesher) {
  for (const named_shape& shape : manifold_shapes()) {
    CAPTURE(shape.name);
    const double h = shape.size;
    mesh_and_check(mesher, shape.boundary, [h](vec3) { return h; });
  }
}

/// A closed surface of unit squares, in two parts that share the wall x = 2, which is listed in both
/// directions.
inline shapes::surface halves_with_a_wall() {
  auto halves = shapes::cells(shapes::block({0, 0, 0}, {4, 2, 2}), {1, 1, 1});
  const std::size_t outside = halves.elements.size();
  const auto left = shapes::cells(shapes::block({0, 0, 0}, {2, 2, 2}), {1, 1, 1});
  for (const auto& t : left.elements) {
    simplex<2> copy{};
    bool on_wall = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const vec3 p = left.points[t[k]];
      on_wall = on_wall && p.x == 2;
      const auto same = std::find(halves.points.begin(), halves.points.end(), p);
      copy[k] = static_cast<local_id>(same - halves.points.begin());
      if (on_wall && same == halves.points.end())
        halves.points.push_back(p);
    }
    if (on_wall) {
      halves.elements.push_back(copy);
      halves.elements.push_back({copy[0], copy[2], copy[1]});
    }
  }
  REQUIRE(halves.elements.size() == outside + 16);
  return halves;
}

/// Boundaries with an edge or a vertex where sheets touch, and an inner interface listed in both directions;
/// for elements of size 1.
inline std::vector<named_shape> non_manifold_shapes() {
  const auto voids_at_an_edge = shapes::block({0, 0, 0}, {4, 4, 3}, [](int x, int y, int z) {
    return z != 1 || !((x == 1 && y == 1) || (x == 2 && y == 2));
  });
  return {{"cubes that share an edge", shapes::cells({{0, 0, 0}, {1, 1, 0}}, {1, 1, 1}), 1},
          {"cubes that share a vertex", shapes::cells({{0, 0, 0}, {1, 1, 1}}, {1, 1, 1}), 1},
          {"voids that share an edge", shapes::cells(voids_at_an_edge, {1, 1, 1}), 1},
          {"inner wall", halves_with_a_wall(), 1}};
}

/// A mesher that accepts these boundaries fills all of them; one that does not fills a boundary rightly or
/// ends in a typed error, and there is one that it refuses: `accepts_non_manifold` is neither more nor less
/// than true.
template <class M>
void check_non_manifold(const M& mesher) {
  int refused = 0;
  for (const named_shape& shape : non_manifold_shapes()) {
    CAPTURE(shape.name);
    const mesher_input<3> input{shape.boundary, 5};
    try {
      const auto mesh = mesher(input, [](vec3) { return 1.0; }).mesh;
      check_mesher_result(input, mesh);
      CHECK(volume_of(mesh) ==
            doctest::Approx(enclosed_volume(input.boundary.points, input.boundary.elements)));
      CHECK(check_validity(mesh).valid());
    } catch (const mesher_error& problem) {
      CHECK_MESSAGE(!M::traits.accepts_non_manifold, problem.what());
      ++refused;
    }
  }
  CHECK(M::traits.accepts_non_manifold == (refused == 0));
}

/// A second call on the same input, with another call between, gives the same mesh.
template <class M>
void check_repeats(const M& mesher) {
  const mesher_input<3> input{shapes::torus(10), 0};
  const any_sizing size = [](vec3) { return 0.15; };
  const auto first = mesher(input, size).mesh;
  mesher(mesher_input<3>{shapes::cube(4, 100), 0}, [](vec3) { return 20.0; });
  const auto second = mesher(input, size).mesh;
  CHECK(first.points == second.points);
  CHECK(first.elements == second.elements);
}

/// What may run in threads gives the same meshes there; what may not is refused there. What repeats itself
/// gives the same mesh at every call.
template <class M>
void check_threads_and_history(const M& mesher) {
  const subdomain_source source = [](local_id s) {
    subdomain_input input;
    input.boundary.boundary = s % 2 == 0 ? shapes::torus(8 + s) : shapes::cube(4 + s);
    input.skeleton_points.resize(input.boundary.boundary.points.size());
    return input;
  };
  const auto run = [&](const auto& executor) {
    const auto result = mesh_subdomains(
        6, source, mesher, no_improver{}, [](vec3) { return 0.2; }, executor);
    CHECK(result.failures.empty());
    byte_writer bytes;
    for (local_id s = 0; s < 6; ++s)
      encode(bytes, result.load(s));
    return bytes.take();
  };
  if constexpr (M::traits.thread_safe)
    CHECK(run(parallel::threads{3}) == run(parallel::serial{}));
  else
    CHECK_THROWS_AS(run(parallel::threads{3}), usage_error);
  if constexpr (M::traits.repeats_in_process)
    check_repeats(mesher);
}

/// The mean edge is the size, on a field with a boundary of the same size.
template <class M>
void check_calibration(const M& mesher, double tolerance = 0.05, int cube_squares = 24) {
  for (const auto& boundary : {shapes::cube(cube_squares), shapes::sphere(cube_squares > 12 ? 4 : 3)}) {
    const double h = shapes::mean_edge(boundary);
    const auto mesh = mesh_and_check(mesher, boundary, [h](vec3) { return h; });
    CHECK(mean_edge(mesh) / h == doctest::Approx(1.0).epsilon(tolerance));
  }
}

/// Edges follow a field that grows away from a point inside, and are not much finer than it anywhere.
template <class M>
void check_grading(const M& mesher) {
  const vec3 source{0.4, 0.5, 0.6};
  const any_sizing size = [source](vec3 p) { return 0.015 + 0.25 * distance(p, source); };
  const auto boundary = shapes::cube(10);
  const auto mesh = mesh_and_check(mesher, boundary, size);
  double sum = 0;
  std::size_t count = 0;
  std::size_t tiny = 0;
  for (const auto& [a, b] : unique_edges(mesh)) {
    const vec3 p = mesh.points[a];
    const vec3 q = mesh.points[b];
    const double ratio = distance(p, q) / size(midpoint(p, q));
    if (distance(midpoint(p, q), source) > 0.3)
      continue; // the boundary is of another size
    sum += ratio;
    ++count;
    tiny += ratio < 0.3;
  }
  REQUIRE(count > 1000);
  CHECK(sum / static_cast<double>(count) == doctest::Approx(1.0).epsilon(0.1));
  CHECK(tiny * 200 < count);
}

/// Bad sizes and bad boundaries end in typed errors.
template <class M>
void check_errors(const M& mesher) {
  const mesher_input<3> input{shapes::cube(4), 0};
  CHECK_THROWS_AS(mesher(input, [](vec3) { return 0.0; }), sizing_error);
  CHECK_THROWS_AS(mesher(input, [](vec3) { return -1.0; }), sizing_error);
  CHECK_THROWS_AS(mesher(input, [](vec3 p) { return p.x > 0.5 ? std::nan("") : 0.3; }), sizing_error);
  const any_sizing fine = [](vec3) { return 0.3; };
  CHECK_THROWS_AS(mesher(mesher_input<3>{}, fine), mesher_error);
  auto open = input;
  open.boundary.elements.pop_back();
  CHECK_THROWS_AS(mesher(open, fine), mesher_error);
  auto inverted = input;
  for (auto& t : inverted.boundary.elements)
    std::swap(t[1], t[2]);
  CHECK_THROWS_AS(mesher(inverted, fine), mesher_error);
  auto dangling = input;
  dangling.boundary.elements[0][1] = 10000;
  CHECK_THROWS_AS(mesher(dangling, fine), mesher_error);
  auto repeated = input;
  repeated.boundary.elements.push_back(repeated.boundary.elements.front());
  CHECK_THROWS_AS(mesher(repeated, fine), mesher_error);
}

/// A dent pushed out through the other side: a failure, never a mesh. In a worker, since a mesher with
/// `may_crash` may take the process along.
template <class M>
void check_self_intersection(const M& mesher) {
  auto crossing = shapes::cube(4);
  const auto top = std::find(crossing.points.begin(), crossing.points.end(), vec3{0.5, 0.5, 1});
  REQUIRE(top != crossing.points.end());
  *top = {0.53, 0.47, -0.3};
  const auto outcomes = parallel::processes{1}.run(1, [&](std::size_t) {
    mesher(mesher_input<3>{crossing, 0}, [](vec3) { return 0.3; });
    return byte_buffer{};
  });
  CHECK_FALSE(outcomes.front().ok);
  CHECK_FALSE(outcomes.front().timed_out);
  CHECK((M::traits.may_crash || !outcomes.front().crashed));
}

} // namespace contract
