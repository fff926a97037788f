#include "dovetail/decomposition/interface_angles.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace dovetail;

namespace {

/// A unit square about its middle, one triangle per side.
struct square {
  simplicial_mesh<2> mesh;
  side_table<2> sides;
  std::vector<side_state> states;

  square() {
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
    mesh.elements = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    sides = build_sides(mesh);
    for (std::size_t s = 0; s < sides.size(); ++s)
      states.push_back(sides.is_interior(static_cast<local_id>(s)) ? side_state::kept : side_state::fixed);
  }
  interface_angles check(const std::vector<local_id>& part, double threshold_deg) const {
    return measure_interface_angles<2>({mesh, sides, states, part}, {0, threshold_deg});
  }
};

} // namespace

TEST_CASE("corners are measured between lines, across the triangles of a part") {
  const auto found = square().check({0, 0, 1, 1}, 50); // cut along one diagonal
  CHECK(found.interface_faces == 2);
  CHECK(found.surface_dihedral.angle_deg == doctest::Approx(45));
  CHECK(found.interface_dihedral.angle_deg == doctest::Approx(180)); // in the middle
  CHECK(found.interface_dihedral.edge[0] == 4);
  REQUIRE(found.violations.size() == 4); // two at each end of the diagonal
  for (const auto& each : found.violations)
    CHECK((each.edge[0] == 0 || each.edge[0] == 2));
  CHECK(found.violations[0].subdomain + found.violations[1].subdomain + found.violations[2].subdomain +
            found.violations[3].subdomain ==
        2);
  CHECK(square().check({0, 0, 1, 1}, 44).violations.empty());
}

TEST_CASE("one part has no corners of its own, and the boundary's are nobody's") {
  const auto found = square().check({0, 0, 0, 0}, 100);
  CHECK(found.interface_faces == 0);
  CHECK(found.violations.empty());
}

TEST_CASE("a line that ends in the middle of a part bounds no corner there") {
  square s;
  // A feature line from one corner to the middle.
  for (std::size_t k = 0; k < s.sides.size(); ++k)
    if (sorted_vertices(s.sides.vertices[k]) == simplex<1>{0, 4})
      s.states[k] = side_state::fixed;
  CHECK(s.check({0, 0, 0, 0}, 400).violations.empty());
}

TEST_CASE("a corner at a refused side is the bound's doing") {
  square s;
  for (auto& state : s.states)
    if (state == side_state::kept)
      state = side_state::refused;
  for (const auto& each : s.check({0, 0, 1, 1}, 50).violations)
    CHECK(each.cause == violation_cause::refused);
  for (const auto& each : square().check({0, 0, 1, 1}, 50).violations)
    CHECK(each.cause == violation_cause::remeshing);
}

TEST_CASE("between fine lines, a corner is as they leave the vertex") {
  const square s;
  const std::vector<local_id> part{0, 0, 1, 1};
  const auto leaves = [&](local_id side, local_id vertex) {
    const auto& ends = s.sides.vertices[side];
    vec3 along = s.mesh.points[ends[0] == vertex ? ends[1] : ends[0]] - s.mesh.points[vertex];
    if (vertex == 0 && ends[0] + ends[1] == 4) // the diagonal leaves the first corner at 30 degrees
      along = {std::sqrt(3.0), 1, 0};
    return along;
  };
  const auto found = measure_interface_angles<2>({s.mesh, s.sides, s.states, part, leaves}, {0, 50});
  CHECK(found.surface_dihedral.angle_deg == doctest::Approx(30));
  CHECK(found.surface_dihedral.edge[0] == 0);
}
