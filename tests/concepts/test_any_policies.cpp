#include "archetypes.hpp"

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/improver/any_improver.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"

#include <doctest/doctest.h>

#include <optional>

namespace dovetail {
namespace {

TEST_CASE("a held partitioner gives what the policy itself gives") {
  csr_graph path;
  path.offsets = {0, 1, 3, 4};
  path.neighbours = {1, 0, 2, 1};
  path.edge_weights.assign(4, 1.0);
  path.node_weights.assign(3, 1.0);
  const any_partitioner held(archetype::partitioner(0), "archetype");
  CHECK(held.name() == "archetype");
  CHECK(held(path, 3) == archetype::partitioner(0)(path, 3));
}

TEST_CASE("a held mesher passes on its input and its traits") {
  mesher_input<3> input;
  input.boundary.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  input.material = 7;
  const any_mesher<3> held(archetype::mesher(0), "archetype");
  CHECK(held.actual_traits().keeps_boundary);
  CHECK_FALSE(held.actual_traits().may_crash);
  const auto result = held(input, {});
  CHECK(result.mesh.points.size() == 4);
  CHECK(result.mesh.tags == std::vector<local_id>{7});
}

struct marking_surface {
  static constexpr bool thread_safe = false;
  patch_mesh operator()(const any_surface& surface, const patch_boundary& b, const any_sizing& h) const {
    patch_mesh made;
    made.inner_uv = b.uv;
    made.inner_points = {surface.frame({1, 2}).point, {h({}), 0, 0}};
    return made;
  }
};

TEST_CASE("a held surface mesher passes on its input, and whether it may run in threads") {
  const any_surface_mesher held(marking_surface{}, "marking");
  CHECK(held.name() == "marking");
  CHECK_FALSE(held.may_run_in_threads());
  CHECK(any_surface_mesher().may_run_in_threads());
  CHECK(any_surface_mesher().name() == "native");
  patch_boundary boundary;
  boundary.uv = {{3, 4}};
  const remesh::plane_surface plane{{5, 0, 0}};
  const auto made = held(any_surface::view_of(plane), boundary, [](vec3) { return 7.0; });
  CHECK(made.inner_uv == boundary.uv);
  CHECK(made.inner_points == std::vector<vec3>{{6, 2, 0}, {7, 0, 0}});
  // As a mesher of pieces it says the same.
  using pieces = mesher::by_regions<any_surface_mesher>;
  CHECK_FALSE(any_mesher<2>(pieces{held}).actual_traits().thread_safe);
  CHECK(any_mesher<2>(pieces{}).actual_traits().thread_safe);
}

TEST_CASE("the fallbacks of a held mesher are the held one's, and then those added") {
  struct climbing : archetype::mesher {
    explicit climbing(int at) : archetype::mesher(0), attempt(at) {}
    climbing(const climbing&) = default;
    std::vector<climbing> fallbacks() const { return {climbing(1), climbing(2)}; }
    mesher_result<3> operator()(const mesher_input<3>&, const any_sizing&) const {
      mesher_result<3> result;
      result.mesh.tags = {attempt};
      return result;
    }
    int attempt;
  };
  const auto held = any_mesher<3>(climbing(0), "climbing").with_fallback({archetype::mesher(0), "archetype"});
  const auto meshers = with_fallbacks(held);
  REQUIRE(meshers.size() == 4);
  for (int attempt = 0; attempt < 3; ++attempt)
    CHECK(meshers[attempt]({}, {}).mesh.tags == std::vector<local_id>{attempt});
  CHECK(meshers[3].name() == "archetype");
}

TEST_CASE("after a held mesher's form for the background come the mesher itself and its fallbacks") {
  struct two_forms : archetype::mesher {
    explicit two_forms(int number) : archetype::mesher(0), mark(number) {}
    two_forms(const two_forms&) = default;
    two_forms for_background() const { return two_forms(1); }
    std::vector<two_forms> fallbacks() const { return {two_forms(mark + 10)}; }
    mesher_result<3> operator()(const mesher_input<3>&, const any_sizing&) const {
      mesher_result<3> result;
      result.mesh.tags = {mark};
      return result;
    }
    int mark;
  };
  const auto marks = [](const any_mesher<3>& mesher) {
    std::vector<local_id> found;
    for (const auto& attempt : with_fallbacks(mesher))
      found.push_back(attempt({}, {}).mesh.tags.front());
    return found;
  };
  const any_mesher<3> held(two_forms(0), "both");
  CHECK(marks(held) == std::vector<local_id>{0, 10});
  CHECK(marks(held.for_background()) == std::vector<local_id>{1, 0, 10});
  CHECK(held.for_background().name() == "both");
  CHECK(held.has_form_for_background());
  CHECK(held.with_fallback(two_forms(7)).has_form_for_background());
  CHECK_FALSE(any_mesher<3>(archetype::mesher(0)).has_form_for_background());
  CHECK(marks(held.with_fallback(two_forms(7)).for_background()) == std::vector<local_id>{1, 0, 10, 7});
  CHECK(with_fallbacks(any_mesher<3>(archetype::mesher(0)).for_background()).size() == 1);
}

struct marking {
  static constexpr improver_traits traits{.thread_safe = true};
  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen, const any_sizing& h) const {
    mesh.points.push_back({h({1, 2, 3}), 0, 0});
    report made;
    made.set("frozen", frozen.points);
    return made;
  }
};

TEST_CASE("a held improver works on the caller's mesh") {
  simplicial_mesh<3> mesh;
  const any_improver<3> held(marking{}, "marking");
  CHECK(held.actual_traits().thread_safe);
  const report made = held(mesh, {.points = 5}, [](vec3 p) { return p.z; });
  CHECK(made.get("frozen") == 5);
  REQUIRE(mesh.points.size() == 1);
  CHECK(mesh.points[0].x == 3);
}

/// Tells what it may not move.
struct telling {
  static constexpr improver_traits traits{};
  report operator()(simplicial_mesh<2>&, const frozen_entities<2>& frozen, const any_sizing&) const {
    report made;
    made.set("frozen", frozen.points);
    return made;
  }
};

TEST_CASE("an improver that is told no surface moves vertices in planes only") {
  static_assert(!surface_improver<telling> && surface_improver<any_improver<2>>);
  const any_improver<2> held(telling{});
  simplicial_mesh<2> mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {3, 8}};
  const auto frozen_on = [&](const surface_host& host) {
    return held(mesh, {.points = 2}, {}, host).get("frozen");
  };
  CHECK(frozen_on({}) == 2);
  surface_host host{[](local_id, vec3 p, vec2) { return host_point{p, {0, 0, 1}, {}}; }};
  CHECK(frozen_on(host) == 4);
  host.plane_normal = [](local_id) { return vec3{0, 0, 1}; };
  CHECK(frozen_on(host) == 2);
  host.plane_normal = [](local_id face) { return face == 3 ? vec3{0, 0, 1} : vec3{}; };
  CHECK(frozen_on(host) == 4);
}

TEST_CASE("a held executor runs every task once, and knows its workers") {
  struct backwards {
    std::vector<task_outcome> run(std::size_t count, const task_function& task, const run_options&) const {
      std::vector<task_outcome> outcomes(count);
      for (std::size_t i = count; i-- > 0;) {
        outcomes[i].ok = true;
        outcomes[i].result = task(i);
      }
      return outcomes;
    }
    int workers() const { return 3; }
    bool shares_process() const { return true; }
  };
  const any_executor held(backwards{}, "backwards");
  CHECK(held.workers() == 3);
  CHECK(runs_in_threads(held));
  const auto outcomes = held.run(4, [](std::size_t i) { return byte_buffer(i); }, {});
  REQUIRE(outcomes.size() == 4);
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(outcomes[i].result.size() == i);
}

TEST_CASE("a held geometry forwards every query with its arguments") {
  struct echo {
    const geometry_topology& topology() const { return entities; }
    vec3 curve_point(local_id c, double t) const { return {double(c), t, 1}; }
    dovetail::curve_frame curve_frame(local_id c, double t) const { return {{double(c), t, 2}, {}}; }
    vec2 curve_uv(local_id f, int k, double t) const { return {double(f) + k, t}; }
    vec3 face_point(local_id f, vec2 uv) const { return {double(f), uv.x, uv.y}; }
    surface_frame face_frame(local_id f, vec2 uv) const { return {{double(f), uv.x, uv.y}, {}, {}}; }
    double face_curvature(local_id f, vec2 uv) const { return f + uv.x + uv.y; }
    vec2 project_to_face(local_id f, vec3 p, vec2 seed) const { return {f + p.x, seed.y}; }
    double project_to_curve(local_id c, vec3 p, double seed) const { return c + p.x + seed; }
    box3 bounds() const { return {{0, 0, 0}, {1, 2, 3}}; }
    bool thread_safe() const { return true; }
    geometry_topology entities;
  };
  echo model;
  model.entities.solids.push_back({"body"});
  const any_geometry held(model);
  CHECK(held.topology().solids.at(0).name == "body");
  CHECK(held.curve_point(4, 0.5) == vec3{4, 0.5, 1});
  CHECK(held.curve_frame(4, 0.5).point == vec3{4, 0.5, 2});
  CHECK(held.curve_uv(4, 2, 0.5) == vec2{6, 0.5});
  CHECK(held.face_point(4, {5, 6}) == vec3{4, 5, 6});
  CHECK(held.face_frame(4, {5, 6}).point == vec3{4, 5, 6});
  CHECK(held.face_curvature(4, {5, 6}) == 15);
  CHECK(held.project_to_face(4, {1, 0, 0}, {5, 6}) == vec2{5, 6});
  CHECK(held.project_to_curve(4, {1, 0, 0}, 0.5) == 5.5);
  CHECK(held.bounds().upper == vec3{1, 2, 3});
  CHECK(held.thread_safe());
  CHECK_FALSE(held.plane_of_face(0).has_value());
  struct with_plane : echo {
    std::optional<surface_frame> plane_of_face(local_id f) const {
      return surface_frame{{double(f), 0, 0}, {}, {}};
    }
  };
  CHECK(any_geometry(with_plane{}).plane_of_face(4)->point.x == 4);
}

} // namespace
} // namespace dovetail
