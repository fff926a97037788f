#include "dovetail/core/encoding.hpp"
#include "dovetail/decomposition/interface_angles.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/quality.hpp"
#include "support/adjacency.hpp"
#include "support/jittered_meshes.hpp"
#include "support/subdomain_boundary.hpp"

#include <doctest/doctest.h>

#include <numeric>
#include <vector>

using namespace dovetail;
using namespace dovetail_test;

namespace {

struct measured {
  double interface_dihedral = 360;
  double surface_dihedral = 360;
  std::size_t below = 0;
};

/// Dihedrals of parts from the elements: around every ridge, the dihedral angles of consecutive elements of
/// one part add up.
measured dihedrals_from_elements(const simplicial_mesh<3>& mesh, const std::vector<local_id>& part,
                                 double threshold) {
  const auto adj = dovetail_test::build_adjacency(mesh);
  measured m;
  for (std::size_t f = 0; f < adj.fan_count(); ++f) {
    struct item {
      local_id part;
      double angle;
      bool surface_from;
      bool surface_to;
    };
    std::vector<item> items;
    for (const std::uint32_t code : adj.ridges.fan(f)) {
      const dihedral w = ridge_table<3>::decode(code);
      const auto e = static_cast<std::size_t>(w.element);
      const auto is_surface = [&](std::size_t end) {
        return adj.sides.is_boundary(adj.sides.of_element[e][w.sides[end]]);
      };
      items.push_back({part[e], dihedral_angles(corners(std::span(mesh.points), mesh.elements[e]))[w.ridge],
                       is_surface(0), is_surface(1)});
    }
    if (adj.ridges.closed[f]) {
      std::size_t start = 0;
      while (start < items.size() &&
             items[start].part == items[(start + items.size() - 1) % items.size()].part)
        ++start;
      if (start == items.size())
        continue; // one part all around
      std::rotate(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(start), items.end());
    }
    for (std::size_t k = 0; k < items.size();) {
      item run = items[k];
      for (++k; k < items.size() && items[k].part == run.part; ++k) {
        run.angle += items[k].angle;
        run.surface_to = items[k].surface_to;
      }
      if (run.surface_from && run.surface_to)
        continue;
      double& minimum = run.surface_from || run.surface_to ? m.surface_dihedral : m.interface_dihedral;
      minimum = std::min(minimum, run.angle);
      m.below += run.angle < threshold ? 1 : 0;
    }
  }
  return m;
}

std::vector<local_id> random_parts(const simplicial_mesh<3>& mesh, int parts, std::uint64_t seed) {
  random_numbers random(seed);
  std::vector<local_id> part(mesh.elements.size());
  for (local_id& p : part)
    p = static_cast<local_id>(random.bits() % static_cast<std::uint64_t>(parts));
  return part;
}

/// The boundaries of parts, without the elements between them.
fine_skeleton skeleton_of(const simplicial_mesh<3>& mesh, const side_table<3>& sides,
                          const std::vector<local_id>& part) {
  auto boundary = subdomain_boundary<3>(mesh, sides, part);
  fine_skeleton skeleton;
  skeleton.points = mesh.points;
  skeleton.sides = std::move(boundary.sides);
  skeleton.subdomains = std::move(boundary.subdomains);
  for (const auto on_surface : boundary.on_surface)
    skeleton.side_hosts.own().push_back(on_surface != 0 ? 0 : no_id);
  return skeleton;
}

/// A flat tent over the triangle (0, 1, 2): the tent is CAD, the floor an interface.
fine_skeleton tent() {
  fine_skeleton skeleton;
  skeleton.points = std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.1}};
  skeleton.sides = std::vector<simplex<2>>{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  skeleton.subdomains = std::vector<std::array<local_id, 2>>{{0, 1}, {1, no_id}, {1, no_id}, {1, no_id}};
  skeleton.side_hosts = std::vector<local_id>{no_id, 5, 5, 5};
  return skeleton;
}

void check_measured(const interface_angles& angles, const simplicial_mesh<3>& mesh,
                    const side_table<3>& sides, const std::vector<local_id>& part, double threshold) {
  const measured expected = dihedrals_from_elements(mesh, part, threshold);
  CHECK(angles.interface_dihedral.angle_deg == doctest::Approx(expected.interface_dihedral));
  CHECK(angles.surface_dihedral.angle_deg == doctest::Approx(expected.surface_dihedral));
  std::size_t dihedrals = 0;
  std::size_t faces = 0;
  for (const angle_violation& v : angles.violations) {
    dihedrals += v.is_dihedral() ? 1 : 0;
    faces += v.is_dihedral() ? 0 : 1;
    CHECK(v.angle_deg < threshold);
    CHECK(v.cause == violation_cause::remeshing); // nothing was refused, and no corner of the cube is sharp
  }
  CHECK(dihedrals == expected.below);
  std::size_t expected_faces = 0;
  double smallest = 360;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [a, b] = sides.elements[s];
    if (b == no_id || part[a] == part[b])
      continue;
    const auto corner = dihedral_angles(corners(std::span(mesh.points), sides.vertices[s]));
    const double angle = *std::min_element(corner.begin(), corner.end());
    smallest = std::min(smallest, angle);
    expected_faces += angle < threshold ? 1 : 0;
  }
  CHECK(angles.face_angle.angle_deg ==
        doctest::Approx(smallest).epsilon(1e-12)); // other edges are multiplied
  CHECK(faces == expected_faces);
}

} // namespace

TEST_CASE("angles measured on the skeleton are those measured through the elements") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto mesh = shuffled(jittered_cubes(4, 0.15, seed), seed);
    const auto sides = build_sides(mesh);
    for (const int parts : {2, 4}) {
      const auto part = random_parts(mesh, parts, seed);
      const wanted_angles wanted{50, 50};
      check_measured(measure_interface_angles<3>({mesh, sides, {}, part}, wanted), mesh, sides, part, 50);
      check_measured(measure_skeleton_angles(skeleton_of(mesh, sides, part), wanted), mesh, sides, part, 50);
    }
  }
}

TEST_CASE("angles measured in shares are those of the whole") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto mesh = shuffled(jittered_cubes(4, 0.15, seed), seed);
    const auto fine = skeleton_of(mesh, build_sides(mesh), random_parts(mesh, 4, seed));
    const auto whole = measure_skeleton_angles(fine, {50, 50});
    REQUIRE(!whole.violations.empty());
    std::vector<std::uint32_t> every(3 * fine.sides.size());
    std::iota(every.begin(), every.end(), 0U);
    for (const std::size_t shares : {1, 2, 7}) {
      const auto half_edges = half_edges_of_shares(fine, every, shares);
      std::vector<interface_angles> of_shares;
      std::size_t with_violations = 0;
      for (std::size_t k = 0; k < shares; ++k) {
        of_shares.push_back(
            measure_skeleton_angles(fine, {50, 50}, {}, {}, mesh_state::valid, {.number = k, .of = shares}));
        with_violations += of_shares.back().violations.empty() ? 0 : 1;
      }
      CHECK(with_violations == shares);
      CHECK(encoded(joined_shares(of_shares)) == encoded(whole));
      for (std::size_t k = 0; k < shares; ++k)
        CHECK(encoded(measure_skeleton_angles(fine, {50, 50}, {}, half_edges[k], mesh_state::valid,
                                              {.number = k, .of = shares})) == encoded(of_shares[k]));
    }
  }
}

TEST_CASE("a share that there is not is refused") {
  CHECK_THROWS_AS(
      measure_skeleton_angles(tent(), {30, 30}, {}, {}, mesh_state::unknown, {.number = 2, .of = 2}),
      usage_error);
  CHECK_THROWS_AS(
      measure_skeleton_angles(tent(), {30, 30}, {}, {}, mesh_state::unknown, {.number = 0, .of = 0}),
      usage_error);
}

TEST_CASE("of shares with equal least angles the first triangles and edges are named") {
  interface_angles a, b;
  a.face_angle = {30, {7, no_id}};
  b.face_angle = {30, {5, no_id}};
  a.interface_dihedral = {20, {1, 2}, {3, 4}};
  b.interface_dihedral = {20, {0, 9}, {3, 8}};
  const auto joined = joined_shares(std::array{a, b});
  CHECK(joined.face_angle.sides[0] == 5);
  CHECK(joined.interface_dihedral.edge == std::array<local_id, 2>{3, 4});
  CHECK(joined.surface_dihedral.angle_deg == 360);
}

TEST_CASE("faces and dihedrals have thresholds of their own") {
  const auto mesh = jittered_cubes(3, 0.15, 1);
  const auto sides = build_sides(mesh);
  const auto part = random_parts(mesh, 3, 1);
  const auto count = [&](const wanted_angles& wanted) {
    std::array<std::size_t, 2> found{};
    for (const auto& angles : {measure_interface_angles<3>({mesh, sides, {}, part}, wanted),
                               measure_skeleton_angles(skeleton_of(mesh, sides, part), wanted)})
      for (const angle_violation& v : angles.violations)
        ++found[v.is_dihedral() ? 1 : 0];
    return found;
  };
  CHECK(count({0, 0}) == std::array<std::size_t, 2>{});
  const auto both = count({50, 50});
  CHECK((both[0] > 0 && both[1] > 0));
  CHECK(count({50, 0}) == std::array<std::size_t, 2>{both[0], 0});
  CHECK(count({0, 50}) == std::array<std::size_t, 2>{0, both[1]});
}

TEST_CASE("the place and the cause of a violation are named") {
  // Two tetrahedra on either side of the triangle (0, 1, 2); the one below is flat.
  simplicial_mesh<3> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.2, -0.02}};
  mesh.elements = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  const auto sides = build_sides(mesh);
  const std::vector<local_id> part{0, 1};
  std::vector<side_state> states(sides.size(), side_state::fixed);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides.is_interior(static_cast<local_id>(s)))
      states[s] = side_state::refused;
  const auto angles = measure_interface_angles<3>({mesh, sides, states, part}, {30, 30});
  CHECK(angles.interface_faces == 1);
  CHECK(angles.face_angle.angle_deg == doctest::Approx(45));
  CHECK(angles.interface_dihedral.angle_deg == 360); // none
  REQUIRE(angles.violations.size() == 3); // the dihedrals of the flat element at the interface's edges
  for (const auto& v : angles.violations) {
    CHECK(v.is_dihedral());
    CHECK(v.subdomain == 1);
    CHECK(v.cause == violation_cause::refused);
  }
  CHECK(angles.surface_dihedral.angle_deg == angles.violations[0].angle_deg);
  CHECK(angles.surface_dihedral.edge == std::array<local_id, 2>{1, 2});
  CHECK(angles.surface_dihedral.angle_deg ==
        doctest::Approx(degrees_per_radian * std::atan2(0.02, 0.5 / std::sqrt(2.0))));
}

TEST_CASE("only the dihedrals of the edges asked for are measured") {
  const std::vector<std::uint32_t> of_one_edge{2, 5}; // (0, 1), opposite the last vertex of both
  const auto angles = measure_skeleton_angles(tent(), {30, 30}, {}, of_one_edge);
  CHECK(angles.interface_faces == 1);
  REQUIRE(angles.violations.size() == 1);
  CHECK(angles.violations[0].edge == std::array<local_id, 2>{0, 1});
}

TEST_CASE("the cause is the coarse side where it ought to have been removed, and remeshing where not") {
  for (const bool known : {false, true}) {
    std::vector<std::uint8_t> refused(4, 0);
    refused[0] = known ? 1 : 0;
    const auto angles = measure_skeleton_angles(tent(), {30, 30}, refused);
    CHECK(angles.min_dihedral_deg() == doctest::Approx(degrees_per_radian * std::atan2(0.1, 0.3)));
    CHECK(angles.count(known ? violation_cause::refused : violation_cause::remeshing) == 3);
    REQUIRE(angles.violations.size() == 3);
    CHECK(angles.violations[0].place == vec3{0.5, 0, 0});
  }
}

TEST_CASE("angles are the same after a journey as bytes") {
  interface_angles angles;
  angles.interface_faces = 7;
  angles.face_angle = {20, {1, no_id}, {no_id, no_id}};
  angles.interface_dihedral = {21, {2, 3}, {4, 5}};
  angles.surface_dihedral = {22, {6, 7}, {8, 9}};
  angles.violations = {{20, violation_cause::remeshing, {1, no_id}, {no_id, no_id}, no_id, {1, 2, 3}, {}},
                       {21, violation_cause::forced, {2, 3}, {4, 5}, 6, {4, 5, 6}, {{2, 11}, {1, 12}}}};
  const byte_buffer bytes = encoded(angles);
  byte_reader from(bytes);
  const auto read = decode<interface_angles>(from);
  CHECK(from.at_end());
  CHECK(read.interface_faces == 7);
  for (const auto member : {&interface_angles::face_angle, &interface_angles::interface_dihedral,
                            &interface_angles::surface_dihedral}) {
    CHECK((read.*member).angle_deg == (angles.*member).angle_deg);
    CHECK((read.*member).sides == (angles.*member).sides);
    CHECK((read.*member).edge == (angles.*member).edge);
  }
  REQUIRE(read.violations.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const angle_violation &mine = angles.violations[i], &theirs = read.violations[i];
    CHECK(theirs.angle_deg == mine.angle_deg);
    CHECK(theirs.cause == mine.cause);
    CHECK(theirs.sides == mine.sides);
    CHECK(theirs.edge == mine.edge);
    CHECK(theirs.subdomain == mine.subdomain);
    CHECK(theirs.place == mine.place);
    CHECK(theirs.cad == mine.cad);
  }
}
