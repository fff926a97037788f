/// Meshes made anew in other sizes: boundary, materials and ids stay; nothing drifts away.
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/mesh/validity.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/adapt.hpp"
#include "dovetail/solver/gather.hpp"
#include "files/stacked_cubes.hpp"
#include "models/discrete_shapes.hpp"
#include "models/model_checks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

auto by_tetgen(int subdomains = 4) {
  generate_options options;
  options.subdomains = subdomains;
  return parameters<>{}.with_mesher(mesher::tetgen{}).with_options(options);
}

vec3 point(const simplicial_mesh<3>& mesh, local_id v) {
  return mesh.points[v];
}

std::map<local_id, double> volume_by_material(const simplicial_mesh<3>& mesh) {
  std::map<local_id, double> sum;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& [a, b, c, d] = mesh.elements[e];
    sum[mesh.tags.empty() ? 0 : mesh.tags[e]] +=
        signed_volume(point(mesh, a), point(mesh, b), point(mesh, c), point(mesh, d));
  }
  return sum;
}

std::map<local_id, double> area_by_id(const adaptable_mesh<3>& whole) {
  std::map<local_id, double> sum;
  for (std::size_t s = 0; s < whole.sides.size(); ++s) {
    const auto& [a, b, c] = whole.sides[s];
    const vec3 p = point(whole.mesh, a);
    sum[whole.side_ids[s]] += 0.5 * norm(cross(point(whole.mesh, b) - p, point(whole.mesh, c) - p));
  }
  return sum;
}

/// By policies of our own, whose meshes are the same with all versions of libraries.
auto by_native(int subdomains = 4) {
  generate_options options;
  options.subdomains = subdomains;
  return parameters<>{}.with_options(options);
}

adaptable_mesh<3> ball(double size) {
  const discrete_model model(repaired(testing::sphere_soup({0, 0, 0}, 1, 12)));
  auto made = io::gather(generate<3>(model, uniform_size(size), by_native()).mesh);
  return {std::move(made.mesh)};
}

/// Least and largest distance from the origin of points on the boundary.
std::pair<double, double> radii(const simplicial_mesh<3>& mesh) {
  std::pair<double, double> found{9, 0};
  const auto sides = build_sides(mesh);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_boundary(static_cast<local_id>(s)))
      for (const auto v : sides.vertices[s]) {
        found.first = std::min(found.first, norm(point(mesh, v)));
        found.second = std::max(found.second, norm(point(mesh, v)));
      }
  return found;
}

/// Two materials, 7 below and 3 above, and ids of all faces, that between the materials included.
adaptable_mesh<3> stacked() {
  auto whole = io::gather(testing::stacked_cubes{.cells = 4, .cuts = 2, .solids = 2}.distributed());
  for (local_id& tag : whole.mesh.tags)
    tag = tag == 0 ? 7 : 3;
  for (local_id& id : whole.side_hosts)
    id += 100;
  return {std::move(whole.mesh), std::move(whole.sides), std::move(whole.side_hosts)};
}

/// Mean edge length of elements at the right or left end of the unit cube.
double mean_edge(const simplicial_mesh<3>& mesh, bool right) {
  double sum = 0, count = 0;
  for (const auto& e : mesh.elements) {
    vec3 centre{};
    for (const local_id v : e)
      centre += point(mesh, v) / 4;
    if (right ? centre.x < 0.8 : centre.x > 0.2)
      continue;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j, ++count)
        sum += distance(point(mesh, e[i]), point(mesh, e[j]));
  }
  return sum / count;
}

} // namespace

TEST_CASE("a ball that is adapted ten times keeps its volume and its surface") {
  adaptable_mesh<3> mesh = ball(0.3);
  const double volume = volume_by_material(mesh.mesh)[0];
  double drift = 0; // of the volume, beside what chords of other lengths cut off
  for (int loop = 0; loop < 10; ++loop) {
    std::vector<double> sizes;
    for (const vec3& p : mesh.mesh.points)
      sizes.push_back(p.x > 0.3 && loop % 2 == 0 ? 0.15 : 0.25);
    const auto made = adapt<3>(mesh, sizes, by_native());
    const report& told = made.summary.find("adaptation");
    drift += told.get("volume_after") - told.get("volume_before") - told.get("explained_change");
    CHECK(std::abs(drift) < 2e-3 * volume);
    mesh = dovetail::whole_mesh(made);
    CHECK(volume_by_material(mesh.mesh)[0] == doctest::Approx(told.get("volume_after")));
    const auto [least, most] = radii(mesh.mesh); // of the polyhedron that it was at first: 0.9955 to 1
    CHECK(least > 0.9955);
    CHECK(most < 1.0005);
  }
}

TEST_CASE("materials, and ids of boundaries and interfaces, are the same after an adaptation") {
  const auto old = stacked();
  const auto made = adapt<3>(old, uniform_size(0.12), by_tetgen());
  REQUIRE(made.failures.empty());
  CHECK(io::check_distributed(made.mesh).text() == "");
  const auto next = dovetail::whole_mesh(made);
  CHECK(next.mesh.elements.size() > 4 * old.mesh.elements.size());
  const auto before = volume_by_material(old.mesh), after = volume_by_material(next.mesh);
  REQUIRE(after.size() == before.size());
  for (const auto& [material, volume] : before)
    CHECK(after.at(material) == doctest::Approx(volume).epsilon(1e-12));
  const auto area_before = area_by_id(old), area_after = area_by_id(next);
  REQUIRE(area_after.size() == area_before.size());
  for (const auto& [id, area] : area_before)
    CHECK(area_after.at(id) == doctest::Approx(area).epsilon(1e-12));
}

TEST_CASE("sizes at points are followed, and grow as fast as they may") {
  const auto old = stacked();
  std::vector<double> sizes;
  for (const vec3& p : old.mesh.points)
    sizes.push_back(p.x < 0.5 ? 0.08 : 0.2);
  const auto next = dovetail::whole_mesh(adapt<3>(old, sizes, by_tetgen(), {.growth = 1}));
  CHECK(mean_edge(next.mesh, false) == doctest::Approx(0.08).epsilon(0.1));
  CHECK(mean_edge(next.mesh, true) > 0.15);
  sizes.assign(sizes.size(), 0.2);
  sizes[0] = 0.05;
  const auto field = sizes_at_points(old.mesh, sizes, 0.1);
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    const double most =
        std::min(0.2, 0.05 + 0.1 * std::sqrt(3.0) * distance(old.mesh.points[0], old.mesh.points[v]));
    CHECK(field(old.mesh.points[v]) <= most + 1e-12);
  }
}

TEST_CASE("the adapted mesh does not depend on the workers") {
  const auto old = stacked();
  const auto in_turn = adapt<3>(old, uniform_size(0.15), by_tetgen());
  const auto at_once =
      adapt<3>(old, uniform_size(0.15), by_tetgen().with_executor(parallel::processes{.worker_count = 2}));
  CHECK(io::mesh_hash(in_turn.mesh) == io::mesh_hash(at_once.mesh));
}

TEST_CASE("triangles are adapted by the same template, with their ids") {
  const auto made = generate<2>(discrete_model(repaired(testing::box_soup({0, 0, 0}, {1, 1, 1}, 2))),
                                uniform_size(0.3), parameters<>{});
  adaptable_mesh<2> old{io::gather(made.mesh).mesh};
  for (local_id& tag : old.mesh.tags)
    tag += 50;
  const auto next =
      dovetail::whole_mesh(adapt<2>(old, std::vector<double>(old.mesh.points.size(), 0.15), parameters<>{}));
  CHECK(next.mesh.elements.size() > 2 * old.mesh.elements.size());
  const auto area_of = [](const simplicial_mesh<2>& mesh) {
    std::map<local_id, double> area;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const auto at = [&](std::size_t k) { return mesh.points[mesh.elements[e][k]]; };
      area[mesh.tags[e]] += 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)));
    }
    return area;
  };
  const auto before = area_of(old.mesh), after = area_of(next.mesh);
  REQUIRE(after.size() == 6);
  for (const auto& [id, area] : before)
    CHECK(after.at(id) == doctest::Approx(area).epsilon(1e-12));
}

TEST_CASE("edges of triangles keep their ids, and ids end where they did") {
  const plane_domain square(drawing_from_svg_path("M0 0 H1 V1 H0 Z"));
  const auto whole = io::gather(generate<2>(square, uniform_size(0.125), parameters<>{}).mesh);
  // The bottom has two ids that meet in its middle, the right side one, the rest none.
  adaptable_mesh<2> old{whole.mesh, whole.sides};
  for (const auto& [a, b] : whole.sides) {
    const vec3 at = midpoint(whole.mesh.points[a], whole.mesh.points[b]);
    old.side_ids.push_back(at.y < 1e-9 ? (at.x < 0.5 ? 7 : 8) : at.x > 1 - 1e-9 ? 9 : no_id);
  }
  const auto length_by_id = [](const adaptable_mesh<2>& mesh) {
    std::map<local_id, double> length;
    for (std::size_t s = 0; s < mesh.sides.size(); ++s)
      length[mesh.side_ids[s]] +=
          distance(mesh.mesh.points[mesh.sides[s][0]], mesh.mesh.points[mesh.sides[s][1]]);
    return length;
  };
  const auto made = adapt<2>(old, uniform_size(0.09), parameters<>{});
  CHECK(made.summary.warnings.empty());
  const auto next = dovetail::whole_mesh(made);
  CHECK(next.sides.size() > old.sides.size());
  const auto before = length_by_id(old), after = length_by_id(next);
  REQUIRE(after.size() == 4);
  for (const auto& [id, length] : before)
    CHECK(after.at(id) == doctest::Approx(length).epsilon(1e-12));

  const auto sides = build_sides(old.mesh);
  local_id inner = 0;
  while (sides.is_boundary(inner))
    ++inner;
  old.sides.push_back(sides.vertices[inner]);
  old.side_ids.push_back(3);
  CHECK(adapt<2>(old, uniform_size(0.09), parameters<>{}).summary.warnings ==
        std::vector<std::string>{
            "1 edges with ids are neither on the boundary nor at a feature; the adapted mesh "
            "knows nothing of them"});
  old.side_ids.push_back(4);
  CHECK_THROWS_AS(adapt<2>(old, uniform_size(0.09), parameters<>{}), mesh_error);
}

TEST_CASE("what cannot be adapted is refused by typed errors") {
  const auto old = stacked();
  const auto tried = [&](std::vector<double> sizes) {
    (void)sizes_at_points(old.mesh, std::move(sizes), 0.25);
  };
  const std::size_t count = old.mesh.points.size();
  CHECK_THROWS_WITH_AS(tried(std::vector<double>(count - 1, 0.1)), doctest::Contains("one size per point"),
                       sizing_error);
  unsigned state = 1;
  for (int round = 0; round < 100; ++round) { // wrong arrays of many kinds
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    constexpr double wrong[] = {0.0, -0.0, -1.0, infinite, -infinite, unknown, -1e-320};
    state = state * 1664525u + 1013904223u;
    std::vector<double> sizes(count, 0.1);
    const std::size_t at = (state >> 8) % count;
    sizes[at] = wrong[static_cast<std::size_t>(round) % std::size(wrong)];
    CHECK_THROWS_WITH_AS(tried(sizes), doctest::Contains(("point " + std::to_string(at)).c_str()),
                         sizing_error);
    CHECK_THROWS_AS(tried(std::vector<double>((state >> 4) % count, 0.1)), sizing_error);
  }
  CHECK_THROWS_AS(tried(std::vector<double>(count, std::nan(""))), sizing_error);
  CHECK_THROWS_AS((void)sizes_at_points(old.mesh, std::vector<double>(count, 0.1), 0), sizing_error);

  const auto refused = [&](const auto& change, const char* why) {
    auto mesh = stacked();
    change(mesh);
    CHECK_THROWS_WITH_AS((void)model_of_boundary(mesh), doctest::Contains(why), mesh_error);
  };
  refused(
      [](auto& m) {
        m.mesh.elements.clear();
        m.mesh.tags.clear();
      },
      "no tetrahedron");
  refused([](auto& m) { m.side_ids.pop_back(); }, "one id per side");
  refused([](auto& m) { m.side_ids[3] = -7; }, "ids are not negative");
  refused([](auto& m) { m.sides[3][1] = 1'000'000; }, "side 3 has the point 1000000");
  refused([](auto& m) { std::swap(m.mesh.elements[5][0], m.mesh.elements[5][1]); }, "not valid");
  refused([](auto& m) { m.mesh.elements[5][0] = 1'000'000; }, "not valid");
  refused([](auto& m) { m.mesh.tags.pop_back(); }, "not valid");
  refused([](auto& m) { m.mesh.points[2].x = std::nan(""); }, "not valid");
}

TEST_CASE("sides with ids inside a material are passed over, which a warning tells") {
  auto old = stacked();
  const auto sides = build_sides(old.mesh);
  std::size_t inside = 0;
  while (!sides.is_interior(static_cast<local_id>(inside)) ||
         old.mesh.tags[sides.elements[inside][0]] != old.mesh.tags[sides.elements[inside][1]])
    ++inside;
  CHECK(model_of_boundary(old).warnings.empty());
  old.sides.push_back(sides.vertices[inside]);
  old.side_ids.push_back(5);
  REQUIRE(model_of_boundary(old).warnings.size() == 1);
  CHECK(model_of_boundary(old).warnings[0].find("1 sides") == 0);
}

TEST_CASE("the smooth model of a boundary is a geometry model") {
  for (const auto& mesh : {ball(0.4), stacked()})
    for (const std::string& fault : testing::faults_of(model_of_boundary(mesh).model))
      FAIL_CHECK(fault);
}
