/// Surfaces from arrays of one's own: what does not fit together is refused, ids come back.
#include "discrete_shapes.hpp"

#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/gather.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <map>
#include <set>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

/// The side of a cube that a triangle lies on: 0, 1 for x, 2, 3 for y, 4, 5 for z.
local_id side_of(const std::vector<vec3>& points, const simplex<2>& triangle) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double level : {0.0, 1.0}) {
      bool on = true;
      for (const local_id v : triangle)
        on = on && points[v][axis] == level;
      if (on)
        return static_cast<local_id>(2 * axis + (level > 0 ? 1 : 0));
    }
  return no_id;
}

constexpr std::array<local_id, 6> own_ids{700, 9, -5, no_id, 41, 9};

void check_refused(triangle_soup soup, const std::string& message) {
  CHECK_THROWS_WITH_AS(repaired(soup), message.c_str(), geometry_error);
}

} // namespace

TEST_CASE("ids of one's own come back on every triangle of the mesh, and as names of groups") {
  const auto cube = box_soup({0, 0, 0}, {1, 1, 1}, 2);
  std::vector<local_id> ids;
  for (const auto& triangle : cube.triangles)
    ids.push_back(own_ids[side_of(cube.points, triangle)]);
  const discrete_model model(cube.points, cube.triangles, ids);
  const auto result = generate<2>(model, uniform_size(0.2), parameters<>{}.with_options({.subdomains = 3}));
  const auto whole = io::gather(result.mesh);
  std::map<local_id, std::set<local_id>> ids_on_side;
  std::map<local_id, std::set<std::string>> names_on_side;
  for (std::size_t t = 0; t < whole.mesh.elements.size(); ++t) {
    const local_id side = side_of(whole.mesh.points, whole.mesh.elements[t]);
    const local_id face = whole.mesh.tags[t];
    ids_on_side[side].insert(model.face_id(face));
    const auto group = static_cast<std::size_t>(whole.group_of_face.at(face));
    names_on_side[side].insert(whole.group_names.at(group));
  }
  REQUIRE(ids_on_side.size() == 6);
  for (const auto& [side, found] : ids_on_side) {
    const local_id wanted = own_ids.at(side);
    CHECK(found == std::set<local_id>{wanted});
    if (wanted != no_id)
      CHECK(names_on_side[side] == std::set<std::string>{std::to_string(wanted)});
  }
}

TEST_CASE("an edge between two ids is a feature, though the surface is flat there") {
  const auto cube = box_soup({0, 0, 0}, {1, 1, 1}, 2);
  std::vector<local_id> ids;
  for (const auto& triangle : cube.triangles) {
    double x = 0;
    for (const local_id v : triangle)
      x += cube.points[v].x / 3;
    ids.push_back(x < 0.5 ? 1 : 2);
  }
  CHECK(discrete_model(cube.points, cube.triangles).topology().faces.size() == 6);
  CHECK(discrete_model(cube.points, cube.triangles, ids).topology().faces.size() == 10);
}

TEST_CASE("patches with names keep the index of their name") {
  auto cube = box_soup({0, 0, 0}, {1, 1, 1});
  cube.groups.assign(cube.triangles.size(), 1);
  cube.group_names = {"unused", "all"};
  const discrete_model model(repaired(cube));
  CHECK(model.face_id(0) == 1);
  CHECK(model.topology().faces[0].group == "all");
}

TEST_CASE("arrays that do not fit together are refused, naming the place") {
  const auto cube = box_soup({0, 0, 0}, {1, 1, 1});
  auto soup = cube;
  soup.triangles[5][1] = 99;
  check_refused(soup, "the surface: triangle 5 refers to point 99, but there are 24 points");
  soup.triangles[5][1] = -1;
  check_refused(soup, "the surface: triangle 5 refers to point -1, but there are 24 points");
  soup = cube;
  soup.groups.assign(3, 0);
  check_refused(soup,
                "the surface: there are 3 groups or ids for 12 triangles; give one per triangle, or none");
  soup.groups.assign(12, 0);
  soup.groups[7] = 2;
  soup.group_names = {"a", "b"};
  check_refused(soup, "the surface: triangle 7 refers to group 2, but there are 2 names of groups");
  soup = cube;
  soup.points[3].y = std::numeric_limits<double>::quiet_NaN();
  check_refused(soup, "the surface: point 3 is not finite");
}
