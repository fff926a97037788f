#include "dovetail/decomposition/extract_skeleton.hpp"
#include "dovetail/skeleton/line_skeleton.hpp"
#include "skeleton/coarse_cube.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <vector>

using namespace dovetail;

namespace {

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
    lines = number_lines(coarse, std::vector<fine_line>(coarse.lines.size()), mesh.surface.mesh.points,
                         mesh.surface.vertex_hosts);
    fine = skeleton_of_lines(mesh.surface, build_sides(mesh.surface.mesh), part, lines);
  }
  chord_rule rule() const { return {coarse, fine, lines, mesh.surface}; }

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

content_key key_of_left(const cut_cube& cube) {
  return cube.rule().key(std::array{cube.region_on(left)}, cube.points_of_left());
}

} // namespace

TEST_CASE(
    "the key of the chords that a piece must not have changes with them, and not with what is elsewhere") {
  const cut_cube plain({}), cut_beside({front}), cut_behind({right});
  REQUIRE(plain.region_on(front) < plain.region_on(left)); // of two regions the first may have the chord
  REQUIRE(plain.points_of_left().size() == 8);
  REQUIRE(cut_beside.points_of_left().size() == 8); // the boundary is the same
  CHECK(forbids_the_edge_of_front(plain));
  CHECK(!forbids_the_edge_of_front(cut_beside));
  CHECK(key_of_left(plain) != key_of_left(cut_beside));

  REQUIRE(cut_behind.lines.points.size() > plain.lines.points.size());
  CHECK(forbids_the_edge_of_front(cut_behind));
  CHECK(key_of_left(plain) == key_of_left(cut_behind));
}
