/// Every stage that can be called alone refuses a mesh that is none, and names the element or point at fault
/// instead of measuring what is not there or blaming a policy.
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/models/discrete/mesh_boundary.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/simplification/angles_of_rule.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"
#include "skeleton/coarse_cube.hpp"
#include "support/jittered_meshes.hpp"
#include "support/refusal.hpp"
#include "support/subdomain_boundary.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace dovetail;
using testing::has;

namespace {

template <int D>
struct broken_mesh {
  std::string what;
  const char* message; ///< part of what is said
  std::function<void(simplicial_mesh<D>&)> change;
};

template <int D>
std::vector<broken_mesh<D>> broken_meshes() {
  const auto turn = [](auto& mesh) { std::swap(mesh.elements[7][0], mesh.elements[7][1]); };
  std::vector<broken_mesh<D>> broken{
      {"inverted", D == 3 ? "element 7 (points" : "in the same direction", turn},
      {"twice", "has the same points",
       [](auto& mesh) {
         mesh.elements.push_back(mesh.elements[7]);
         if (!mesh.tags.empty())
           mesh.tags.push_back(mesh.tags[7]);
       }},
      {"not a number", "point 3 is at (", [](auto& mesh) { mesh.points[3].x = std::nan(""); }},
      {"infinite", "point 3 is at (",
       [](auto& mesh) { mesh.points[3].z = std::numeric_limits<double>::infinity(); }},
      {"out of range", "element 7 refers to point 9999", [](auto& mesh) { mesh.elements[7][1] = 9999; }},
      {"flat", "is flat", [](auto& mesh) {
         const auto& element = mesh.elements[7];
         const auto at = [&](std::size_t k) -> vec3& { return mesh.points[element[k]]; };
         at(D) = at(0);
       }}};
  return broken;
}

/// All faults of D against stages; `stage(mesh, sides)` gets the sides of the broken mesh where it has any.
template <int D, class Stage>
void refuses_all(const std::string& name, const simplicial_mesh<D>& valid, const Stage& stage) {
  CAPTURE(name);
  CHECK(testing::refusal_of<error>([&] { return stage(valid, build_sides(valid)), 0; }) == "accepted");
  for (const auto& broken : broken_meshes<D>()) {
    CAPTURE(broken.what);
    auto mesh = valid;
    broken.change(mesh);
    auto sides = build_sides(valid);
    try {
      sides = build_sides(mesh);
    } catch (const mesh_error&) { // points out of range have no sides
    }
    const auto told = testing::refusal_of<mesh_error>([&] { return stage(mesh, sides), 0; });
    CHECK(has(told, broken.message));
  }
}

template <int D>
void simplify_refuses(const simplicial_mesh<D>& valid) {
  refuses_all<D>("simplify", valid, [](const auto& mesh, const auto& sides) {
    return simplify<D>(mesh, mesh_duals<D>(mesh, sides), simplifier::paper{});
  });
  refuses_all<D>("side_dual and contract_bounded", valid, [](const auto& mesh, const auto& sides) {
    const simplifier::paper rule;
    const side_dual<D> dihedrals(mesh, sides); // before the rule is asked
    return contract_bounded(element_dual<D>(sides), dihedrals, rule(mesh, sides), rule);
  });
  const auto known = simplify<D>(valid, mesh_duals<D>(valid), simplifier::paper{});
  refuses_all<D>("decompose", valid, [&](const auto& mesh, const auto& sides) {
    return decompose<D>(mesh, sides, known.super_of_element, known.graph, {}, partition::greedy{}, 2);
  });
  const std::vector<local_id> parts = [&] {
    std::vector<local_id> part(valid.elements.size(), 0);
    for (std::size_t e = 0; e < part.size(); ++e)
      part[e] = valid.points[valid.elements[e][0]].x < 0.5 ? 0 : 1;
    return part;
  }();
  refuses_all<D>("measure_interface_angles", valid, [&](const auto& mesh, const auto& sides) {
    return measure_interface_angles<D>({mesh, sides, {}, parts}, wanted_angles_of<D>(simplifier::paper{}));
  });
}

} // namespace

TEST_CASE("simplification, contraction, decomposition and angles refuse meshes of tetrahedra that are none") {
  simplify_refuses<3>(dovetail_test::jittered_cubes(3));
}

TEST_CASE("simplification, contraction, decomposition and angles refuse meshes of triangles that are none") {
  simplify_refuses<2>(dovetail_test::jittered_squares(6));
}

TEST_CASE("a background mesh is looked at before sizes are asked for its elements") {
  const auto mesh = dovetail_test::cube(3);
  const auto given = bind_parameters<3>(parameters<>{});
  const any_sizing size = [](vec3 p) {
    REQUIRE(std::isfinite(norm(p)));
    return 0.1;
  };
  refuses_all<3>("divide", mesh.volume, [&](const auto& volume, const auto&) {
    auto coarse = mesh;
    coarse.volume = volume;
    return divide<3>(coarse, size, 2, given);
  });
}

TEST_CASE("the simplification of a solid looks at its surface and at its volume") {
  const auto mesh = dovetail_test::cube(3);
  std::vector<simplex<1>> curves;
  for (const auto& edge : mesh.surface.curve_edges)
    curves.push_back(edge.vertices);
  refuses_all<3>("simplify_coupled, volume", mesh.volume, [&](const auto& volume, const auto& sides) {
    return simplify_coupled({mesh.surface.mesh, {.fixed_sides = curves}}, {volume, sides},
                            simplifier::paper{});
  });
  const auto sides = build_sides(mesh.volume);
  refuses_all<2>("simplify_coupled, surface", mesh.surface.mesh, [&](const auto& surface, const auto&) {
    return simplify_coupled({surface, {.fixed_sides = curves}}, {mesh.volume, sides}, simplifier::paper{});
  });
  const std::vector<local_id> wrong(mesh.surface.mesh.points.size(), 9999);
  CHECK_THROWS_WITH_AS(simplify_coupled({mesh.surface.mesh, {.fixed_sides = curves}}, {mesh.volume, sides},
                                        simplifier::paper{}, {}, wrong),
                       doctest::Contains("point 0 of the surface is point 9999 of the volume"), usage_error);
}

TEST_CASE("the skeleton is extracted of valid meshes, with one number per element") {
  const auto valid = dovetail_test::cube(3);
  std::vector<local_id> part;
  for (const auto& element : valid.volume.elements)
    part.push_back(valid.volume.points[element[0]].x < 0.5 ? 0 : 1);
  const auto with_volume = [&](const simplicial_mesh<3>& volume) {
    auto mesh = valid;
    mesh.volume = volume;
    return mesh;
  };
  refuses_all<3>("extract_skeleton", valid.volume, [&](const auto& volume, const auto& sides) {
    return extract_skeleton(with_volume(volume), sides, part);
  });
  refuses_all<3>("interface_faces", valid.volume, [&](const auto& volume, const auto& sides) {
    return interface_faces(with_volume(volume), sides, part);
  });
  refuses_all<2>("extract_skeleton of a surface", valid.surface.mesh, [&](const auto& mesh, const auto&) {
    surface_mesh surface = valid.surface;
    surface.mesh = mesh;
    surface.corner_uv.resize(mesh.elements.size());
    return extract_skeleton(surface, own_subdomains(std::vector<local_id>(mesh.elements.size(), 0)));
  });
  CHECK_THROWS_WITH_AS(extract_skeleton(valid, build_sides(valid.volume), std::vector<local_id>(3, 0)),
                       doctest::Contains("3 subdomains for 162 elements"), usage_error);
  auto bare = valid.surface;
  bare.vertex_hosts.pop_back();
  CHECK_THROWS_WITH_AS(
      extract_skeleton(bare, own_subdomains(std::vector<local_id>(bare.mesh.elements.size(), 0))),
      doctest::Contains("hosts"), usage_error);
}

TEST_CASE("interface angles are measured between triangles that are there once and oriented") {
  const auto mesh = dovetail_test::jittered_cubes(3);
  std::vector<local_id> part;
  for (const auto& element : mesh.elements)
    part.push_back(mesh.points[element[0]].x < 0.5 ? 0 : 1);
  const auto whole = dovetail_test::subdomain_boundary<3>(mesh, build_sides(mesh), part);
  std::size_t interface = 0; // a triangle of it
  while (whole.subdomains[interface][1] == no_id)
    ++interface;
  const auto told = [&](const auto& change) {
    fine_skeleton fine;
    fine.points = mesh.points;
    fine.sides = whole.sides;
    fine.subdomains = whole.subdomains;
    fine.side_hosts.own().assign(whole.sides.size(), no_id);
    change(fine.points.own(), fine);
    return testing::refusal_of<mesh_error>(
        [&] { return measure_skeleton_angles(fine, wanted_angles_of<3>(simplifier::paper{})); });
  };
  const std::string name = "triangle " + std::to_string(interface);
  CHECK(told([](auto&, auto&) {}) == "accepted");
  CHECK(has(told([&](auto& points, auto&) { points[3].y = std::nan(""); }), "point 3 is at ("));
  CHECK(has(told([&](auto&, auto& b) { b.sides.own()[interface][1] = 9999; }), name));
  CHECK(has(told([&](auto&, auto& b) { b.sides.own()[interface][1] = b.sides[interface][0]; }), "flat"));
  CHECK(has(told([&](auto&, auto& b) {
              auto& triangle = b.sides.own()[interface];
              std::swap(triangle[0], triangle[1]);
            }),
            "orient each triangle outwards of its first subdomain"));
  CHECK(has(told([&](auto&, auto& b) {
              b.sides.own().push_back(b.sides[interface]);
              b.subdomains.own().push_back(b.subdomains[interface]);
              b.side_hosts.own().push_back(no_id);
            }),
            "has the same points"));
}

TEST_CASE("numbers per element are looked at") {
  const auto mesh = dovetail_test::jittered_cubes(2);
  const auto sides = build_sides(mesh);
  const auto known = simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::paper{});
  auto supers = known.super_of_element;
  supers[5] = 9999;
  CHECK_THROWS_WITH_AS(decompose<3>(mesh, sides, supers, known.graph, {}, partition::greedy{}, 2),
                       doctest::Contains("element 5 has the number 9999 among the super-elements"),
                       usage_error);
  supers.pop_back();
  CHECK_THROWS_WITH_AS(decompose<3>(mesh, sides, supers, known.graph, {}, partition::greedy{}, 2),
                       doctest::Contains("47 super-elements for 48 elements"), usage_error);
  CHECK_THROWS_WITH_AS(measure_interface_angles<3>({mesh, sides, {}, supers}, {30, 30}),
                       doctest::Contains("47 parts"), usage_error);
  std::vector<double> weights(48, 1.0);
  weights[4] = std::nan("");
  CHECK_THROWS_WITH_AS(
      simplify<3>(mesh, mesh_duals<3>(mesh, sides, {.element_weights = weights}), simplifier::paper{}),
      doctest::Contains("element 4 has the weight nan"), usage_error);
}

TEST_CASE("the improver mends inverted elements, and refuses what is no mesh") {
  const auto told = [](const auto& change) {
    auto mesh = dovetail_test::jittered_cubes(2);
    change(mesh);
    return testing::refusal_of<mesh_error>([&] { return native_improver{}(mesh); });
  };
  CHECK(told([](auto&) {}) == "accepted");
  CHECK(has(told([](auto& m) { m.points[3].x = std::nan(""); }), "point 3"));
  CHECK(has(told([](auto& m) { m.elements.push_back(m.elements[7]); }), "more than two elements"));
  CHECK(has(told([](auto& m) { m.elements[7][1] = 9999; }), "point 9999"));
  auto mesh = dovetail_test::jittered_cubes(2);
  const auto size = [&](double h) {
    auto copy = mesh;
    return testing::refusal_of<sizing_error>(
        [&] { return native_improver{.target_angle = 60}(copy, {}, any_sizing([h](vec3) { return h; })); });
  };
  CHECK(size(0.5) == "accepted");
  for (const double h : {0.0, -1.0, std::nan("")})
    CHECK(has(size(h), "the size at ("));
}
