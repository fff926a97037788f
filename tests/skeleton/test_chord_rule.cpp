#include "concepts/archetypes.hpp"
#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/skeleton/line_skeleton.hpp"
#include "skeleton/coarse_cube.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

using namespace dovetail;

namespace {

/// Has planes of some faces, whatever the cube's are, and nothing else.
struct planes : archetype::geometry {
  std::map<local_id, vec3> normals; ///< by face; a plane is as far from the origin as its normal is long

  std::optional<surface_frame> plane_of_face(local_id f) const {
    const auto found = normals.find(f);
    if (found == normals.end())
      return std::nullopt;
    const vec3 n = normalized(found->second);
    const vec3 du = normalized(cross(n, vec3{0.3, 0.5, 0.7}));
    surface_frame frame{};
    frame.point = found->second;
    frame.du = du;
    frame.dv = cross(n, du);
    return frame;
  }
  box3 bounds() const { return {{0, 0, 0}, {1, 1, 1}}; }
};

/// The surface of a cube, each of its faces a subdomain, and the upper half of some faces one more.
struct cut_cube {
  background_mesh mesh = dovetail_test::cube(2);
  coarse_skeleton coarse;
  numbered_lines lines;
  simplicial_skeleton<2> fine;

  explicit cut_cube(std::vector<local_id> cut_faces) {
    std::vector<local_id> part = mesh.surface.mesh.tags;
    for (std::size_t t = 0; t < part.size(); ++t)
      for (const local_id face : cut_faces)
        if (part[t] == face && height(mesh.surface.mesh.elements[t]) > 0.5)
          part[t] = 6 + face;
    coarse = extract_skeleton(mesh.surface, own_subdomains(part));
    lines = number_lines(coarse, {std::vector<fine_line>(coarse.lines.size()), {}}, mesh.surface.mesh.points,
                         mesh.surface.vertex_hosts);
    fine = skeleton_of_lines(mesh.surface, build_sides(mesh.surface.mesh), part, lines);
  }
  chord_rule rule(const planes& flat = {}) const { return {flat, coarse, fine, lines, mesh.surface}; }

  double height(const simplex<2>& triangle) const {
    double sum = 0;
    for (const local_id v : triangle)
      sum += mesh.volume.points[v].z / 3;
    return sum;
  }
  local_id region_on(local_id face) const {
    for (std::size_t r = 0; r < coarse.regions.size(); ++r)
      if (coarse.regions[r].cad_face == face)
        return static_cast<local_id>(r);
    return no_id;
  }
  /// The skeleton's point at a place.
  local_id point(vec3 at) const {
    for (std::size_t v = 0; v < lines.points.size(); ++v)
      if (lines.points[v] == at)
        return static_cast<local_id>(v);
    return no_id;
  }
  /// The skeleton's points on the wall x = 0.
  std::vector<local_id> points_of_left() const {
    std::vector<local_id> points;
    for (std::size_t v = 0; v < lines.points.size(); ++v)
      if (lines.points[v].x == 0)
        points.push_back(static_cast<local_id>(v));
    return points;
  }
};

constexpr local_id left = 0, right = 1, front = 2; // x = 0, x = 1, y = 0

bool forbids_the_edge_of_front(const cut_cube& cube) {
  return cube.rule().forbids(cube.region_on(left), cube.point({0, 0, 0}), cube.point({0, 0, 1}));
}

/// Whether the chord over the wall y = 0 between the other walls' corners is forbidden there.
bool forbids_over_front(const cut_cube& cube, const planes& flat) {
  return cube.rule(flat).forbids(cube.region_on(front), cube.point({0, 0, 0}), cube.point({1, 0, 1}));
}

std::vector<std::int64_t> facts_of_front(const cut_cube& cube, const planes& flat) {
  std::vector<local_id> points;
  for (std::size_t v = 0; v < cube.lines.points.size(); ++v)
    if (cube.lines.points[v].y == 0)
      points.push_back(static_cast<local_id>(v));
  return cube.rule(flat).facts(std::array{cube.region_on(front)}, points);
}

std::vector<std::int64_t> facts_of_left(const cut_cube& cube) {
  return cube.rule().facts(std::array{cube.region_on(left)}, cube.points_of_left());
}

} // namespace

TEST_CASE(
    "the facts about chords that a piece must not have change with them, and not with what is elsewhere") {
  const cut_cube plain({}), cut_beside({front}), cut_behind({right});
  REQUIRE(plain.region_on(front) < plain.region_on(left)); // of two regions the first may have the chord
  REQUIRE(plain.points_of_left().size() == 8);
  REQUIRE(cut_beside.points_of_left().size() == 8); // the boundary is the same
  CHECK(forbids_the_edge_of_front(plain));
  CHECK(!forbids_the_edge_of_front(cut_beside));
  CHECK(facts_of_left(plain) != facts_of_left(cut_beside));

  REQUIRE(cut_behind.lines.points.size() > plain.lines.points.size());
  CHECK(forbids_the_edge_of_front(cut_behind));
  CHECK(facts_of_left(plain) == facts_of_left(cut_behind));
}

TEST_CASE("a flat region may have a chord before those that are curved, whichever comes first") {
  const cut_cube cube({front});
  REQUIRE(cube.region_on(front) < cube.region_on(left));
  // Half-way up the edge between both, so that the chord is no edge of a line.
  const local_id low = cube.point({0, 0, 0}), high = cube.point({0, 0, 1});
  const auto forbidden = [&](const planes& flat) {
    return std::array{cube.rule(flat).forbids(cube.region_on(front), low, high),
                      cube.rule(flat).forbids(cube.region_on(left), low, high)};
  };
  CHECK(forbidden({{}, {{left, {1, 0, 0}}}})[0]);
  CHECK(!forbidden({{}, {{left, {1, 0, 0}}}})[1]);
}

TEST_CASE("a curved region has no chord in the plane of two faces beside it, and its facts tell") {
  const cut_cube cube({});
  const planes one_plane{{}, {{left, {1, 0, 0}}, {right, {1, 0, 0}}}};
  const planes two_planes{{}, {{left, {1, 0, 0}}, {right, {2, 0, 0}}}};
  const planes inclined{{}, {{left, {1, 0, 0}}, {right, {0, 1, 0}}}};
  CHECK(forbids_over_front(cube, one_plane));
  CHECK(!forbids_over_front(cube, two_planes));
  CHECK(!forbids_over_front(cube, inclined));
  CHECK(!forbids_over_front(cube, {{}, {{left, {1, 0, 0}}}}));
  CHECK(facts_of_front(cube, one_plane) != facts_of_front(cube, two_planes));
  CHECK(facts_of_front(cube, inclined) == facts_of_front(cube, two_planes));
  const planes all_flat{{}, {{left, {1, 0, 0}}, {right, {1, 0, 0}}, {front, {0, 1, 0}}}};
  CHECK(!forbids_over_front(cube, all_flat)); // its triangles are in its own plane
}
