#include "dovetail/decomposition/local_repartition.hpp"
#include "dovetail/partition/connectivity.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/simplification/simplify.hpp"
#include "support/jittered_meshes.hpp"
#include "support/subdomain_boundary.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace dovetail;
using namespace dovetail_test;

namespace {

using places_to_avoid = std::vector<std::vector<local_id>>;

struct decomposed {
  explicit decomposed(simplicial_mesh<3> given, int parts)
      : mesh(std::move(given)), sides(build_sides(mesh)) {
    const auto simplified = simplify<3>(mesh, mesh_duals<3>(mesh, sides), simplifier::none{});
    pieces = decompose<3>(mesh, sides, simplified.super_of_element, simplified.graph, {}, partition::greedy{},
                          parts);
  }

  std::vector<local_id> sides_between_parts() const {
    const auto found = subdomain_boundary<3>(mesh, sides, pieces.part_of_element);
    std::vector<local_id> between;
    for (std::size_t k = 0; k < found.sides.size(); ++k)
      if (found.on_surface[k] == 0)
        between.push_back(found.side_ids[k]);
    return between;
  }
  bool is_between(local_id side, const std::vector<local_id>& part) const {
    const auto& [a, b] = sides.elements[side];
    return part[a] != part[b];
  }
  std::vector<local_id> defective_points(const std::vector<local_id>& part) const {
    boundary_defects<3> defects(mesh, sides);
    std::vector<local_id> points;
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      if (defects.count_at(static_cast<local_id>(v), [&](local_id e) { return part[e]; }).any())
        points.push_back(static_cast<local_id>(v));
    return points;
  }

  simplicial_mesh<3> mesh;
  side_table<3> sides;
  decomposition pieces;
};

} // namespace

TEST_CASE("interfaces avoid sides, and go on to avoid them; parts stay connected and manifold") {
  const decomposed given(jittered_cubes(7, 0.15, 1), 5);
  REQUIRE(given.defective_points(given.pieces.part_of_element).empty());
  local_repartition<3> repartition(given.mesh, given.sides, given.pieces);
  std::vector<local_id> part = given.pieces.part_of_element, all;
  const auto between = given.sides_between_parts();
  REQUIRE(between.size() > 100);
  for (int round = 0; round < 6; ++round) {
    CAPTURE(round);
    places_to_avoid places;
    for (std::size_t k = static_cast<std::size_t>(round); k < between.size(); k += 40)
      if (given.is_between(between[k], part)) {
        places.push_back({between[k]});
        all.push_back(between[k]);
      }
    REQUIRE_FALSE(places.empty());
    CHECK(repartition.avoid(places, part, given.pieces.parts) > 0);
    for (const local_id side : all)
      CHECK_FALSE(given.is_between(side, part));
    CHECK(given.defective_points(part).empty());
    CHECK(components_within(given.pieces.graph, part).count == given.pieces.parts);
  }
}

TEST_CASE("of a place with two sides one is enough; what is avoided already stays as it is") {
  const decomposed given(jittered_cubes(6, 0.15, 2), 3);
  local_repartition<3> repartition(given.mesh, given.sides, given.pieces);
  std::vector<local_id> part = given.pieces.part_of_element;
  const auto between = given.sides_between_parts();
  const std::vector<local_id> both{between.front(), between.back()};
  const places_to_avoid place{both};
  CHECK(repartition.avoid(place, part, given.pieces.parts) > 0);
  CHECK(given.is_between(both[0], part) != given.is_between(both[1], part));
  const auto before = part;
  CHECK(repartition.avoid(place, part, given.pieces.parts) == 0);
  CHECK(part == before);
}

TEST_CASE("no part is emptied") {
  const decomposed two(jittered_cubes(1, 0, 1), 6); // six tetrahedra in a cube, each a part
  std::vector<local_id> part = two.pieces.part_of_element;
  const auto before = part;
  local_repartition<3> repartition(two.mesh, two.sides, two.pieces);
  const places_to_avoid place{{two.sides_between_parts().front()}};
  CHECK(repartition.avoid(place, part, two.pieces.parts) == 0);
  CHECK(part == before);
}
