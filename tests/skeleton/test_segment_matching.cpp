#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/skeleton/segment_matching.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

const any_geometry no_lines_on_it(plane_domain({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, {}}));
const any_sizing unit_size = [](vec3) { return 1.0; };

/// Two interface faces inside a domain, one on either side of the line (0, 1).
struct two_faces {
  std::vector<vec3> points;
  coarse_skeleton skeleton;
  std::size_t matched = 0; ///< lines, by the last `remesh`
  bool named = true;       ///< whether lines come with their names
  matched_faces made_segments = {};
  progress on_progress = {}; ///< of the matching

  explicit two_faces(std::vector<vec3> corners) : points(std::move(corners)) {
    for (const auto& [a, b] : {simplex<1>{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}})
      skeleton.lines.push_back({{a, b}, {3, no_id}, {}, {}});
    skeleton.faces = {{{0, 1, 2}, {0, 1}}, {{0, 3, 1}, {0, 1}}};
  }

  remeshed_skeleton remesh(double least_angle_deg) {
    memo<fine_line> made_lines;
    region_memo made_patches;
    const refined_sizing size(unit_size);
    numbered_lines lines;
    const surface_mesh no_surface;
    const std::vector<local_id> material{0};
    const skeleton_to_remesh of{no_lines_on_it, no_surface, points, skeleton, lines, size, material};
    const auto fill = [&] {
      lines = number_lines(
          skeleton,
          remesh_lines(no_lines_on_it, skeleton.lines, points, size, parallel::serial{}, made_lines), points,
          {});
      return mesh_patches(of, any_surface_mesher(), parallel::serial{}, made_patches);
    };
    auto patches = fill();
    matched = match_segments(
        no_lines_on_it, points, skeleton, {lines.lines, named ? lines.names : std::vector<kept<fine_line>>{}},
        faces_with_small_angles(patches, skeleton, made_patches, least_angle_deg), size, least_angle_deg,
        any_surface_mesher(), parallel::serial{}, made_segments, on_progress);
    return join_patches(of, matched == 0 ? std::move(patches) : fill(), parallel::serial{}, made_patches);
  }
};

double least_angle(const fine_skeleton& fine) {
  double least = 180;
  for (const simplex<2>& t : fine.sides)
    least = std::min(least, smallest_corner_angle(corners(span_of(fine.points), t)));
  return least;
}

} // namespace

TEST_CASE("lines that would halve a corner get numbers of segments that suit each other") {
  // Sides of 3.1, 3.3 and 1.9: two, four and two segments, and a corner of 34 degrees between the first two.
  two_faces faces({{0, 0, 0}, {3.1, 0, 0}, {2.74, 1.85, 0}, {1.5, -2.6, 0}});
  const double untouched = least_angle(faces.remesh(0).fine);
  CHECK(untouched < 29);
  for (const skeleton_line& line : faces.skeleton.lines)
    CHECK(line.segments == 0);

  const auto matched = faces.remesh(30);
  CHECK(least_angle(matched.fine) >= 30);
  CHECK(faces.matched > 0);
  const auto segments = static_cast<std::size_t>(faces.skeleton.lines[0].segments);
  CHECK(segments + static_cast<std::size_t>(faces.skeleton.lines[1].segments) > 0);

  two_faces again({{0, 0, 0}, {3.1, 0, 0}, {2.74, 1.85, 0}, {1.5, -2.6, 0}});
  CHECK(again.remesh(30).fine.points == matched.fine.points);
}

TEST_CASE("a line with two segments beside one with one gives way to the short line") {
  // Cutting a short base off leaves a flat triangle, unless the cut is nearer to the base.
  two_faces faces({{0, 0, 0}, {1.37, 0, 0}, {1.12, 0.78, 0}, {0.69, -1.19, 0}});
  CHECK(least_angle(faces.remesh(0).fine) < 30);
  CHECK(least_angle(faces.remesh(30).fine) >= 30);
}

TEST_CASE("a face whose corner is too small itself does not get worse") {
  two_faces faces({{0, 0, 0}, {3.1, 0, 0}, {3, 0.4, 0}, {1.5, -2.6, 0}});
  const double untouched = least_angle(faces.remesh(0).fine);
  CHECK(untouched < 10);
  const double tried = least_angle(faces.remesh(30).fine);
  CHECK(tried >= untouched - 1e-9);
}

TEST_CASE("what was found for a face is found again, for the same lines and threshold only") {
  two_faces faces({{0, 0, 0}, {3.1, 0, 0}, {2.74, 1.85, 0}, {1.5, -2.6, 0}});
  const auto first = faces.remesh(30).fine.points;
  const std::size_t made = faces.made_segments.made();
  CHECK(made > 0);
  const auto start_again = [&] {
    for (skeleton_line& line : faces.skeleton.lines)
      line.segments = 0, line.bias = 0;
  };
  start_again();
  CHECK(faces.remesh(30).fine.points == first);
  CHECK(faces.made_segments.made() == made);
  start_again();
  faces.remesh(31);
  CHECK(faces.made_segments.made() > made);
}

TEST_CASE("the outline of an interface face is the boundary of its patch") {
  two_faces faces({{0, 0, 0}, {3.1, 0, 0}, {2.74, 1.85, 0}, {1.5, -2.6, 0}});
  memo<fine_line> made;
  const auto lines = number_lines(faces.skeleton,
                                  remesh_lines(no_lines_on_it, faces.skeleton.lines, faces.points,
                                               refined_sizing(unit_size), parallel::serial{}, made),
                                  faces.points, {});
  for (const skeleton_face& face : faces.skeleton.faces) {
    const auto outline = interface_outline(face, lines_of(face, lines.keys), lines);
    const auto boundary = interface_patch(face, faces.points, lines).patch.boundary;
    CHECK(outline.labels.size() > 5);
    CHECK(outline.labels == boundary.labels);
    CHECK(outline.segments == boundary.segments);
  }
}

TEST_CASE("lines without names are matched as those that have them") {
  const std::vector<vec3> corners{{0, 0, 0}, {3.1, 0, 0}, {2.74, 1.85, 0}, {1.5, -2.6, 0}};
  two_faces with(corners), without(corners);
  without.named = false;
  const auto first = with.remesh(30), second = without.remesh(30);
  CHECK(with.matched > 0);
  CHECK(with.matched == without.matched);
  CHECK(first.fine.sides == second.fine.sides);
  CHECK(without.made_segments.made() == with.made_segments.made());
}

TEST_CASE("a request to stop ends the matching") {
  two_faces faces({{0, 0, 0}, {3.1, 0, 0}, {2.74, 1.85, 0}, {1.5, -2.6, 0}});
  faces.on_progress.stop_requested = [] { return true; };
  CHECK_THROWS_AS(faces.remesh(30), cancelled);
}

namespace {

/// Interface faces on all triangles of a grid of n x n cells, without points inside their lines.
coarse_skeleton grid_of_faces(local_id n) {
  coarse_skeleton grid;
  const auto vertex = [n](local_id i, local_id j) { return i * (n + 1) + j; };
  std::set<simplex<1>> lines;
  const auto face = [&](simplex<2> vertices) {
    grid.faces.push_back({vertices, {0, 1}});
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)})
      lines.insert(sorted_vertices(
          simplex<1>{vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)]}));
  };
  for (local_id i = 0; i < n; ++i)
    for (local_id j = 0; j < n; ++j) {
      face({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
      face({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
    }
  for (const simplex<1>& line : lines)
    grid.lines.push_back({line, {3, no_id}, {}, {}});
  return grid;
}

} // namespace

TEST_CASE("faces that look at each other's lines are mended in their order, the others side by side") {
  const coarse_skeleton grid = grid_of_faces(40);
  const std::vector<vec3> points(41 * 41);
  const std::vector<fine_line> lines(grid.lines.size());
  const refined_sizing size(unit_size);
  const auto lines_of_face = lines_of_faces(grid);
  const auto faces_of_line = faces_of_lines(lines_of_face, lines.size());
  const detail::matched_skeleton skeleton(points, grid, lines, size, 30, lines_of_face, faces_of_line);
  std::mt19937 random(1);
  for (const unsigned of_hundred : {2U, 20U, 100U}) { // apart, in groups, all in one
    std::vector<local_id> wanted;
    for (std::size_t f = 0; f < grid.faces.size(); ++f)
      if (random() % 100 < of_hundred)
        wanted.push_back(static_cast<local_id>(f));
    const auto passes = detail::matching_passes(skeleton, wanted).passes();
    struct turn {
      std::size_t pass, group, place;
    };
    std::map<local_id, turn> turns;
    std::size_t groups = 0;
    for (std::size_t pass = 0; pass < passes.size(); ++pass)
      for (const auto& group : passes[pass]) {
        for (std::size_t k = 0; k < group.size(); ++k)
          turns[group[k]] = {pass, groups, k};
        CHECK(group.size() <= 32);
        ++groups;
      }
    CHECK(turns.size() == wanted.size());
    CHECK((passes.size() > 1) == (of_hundred == 100));
    CHECK(passes.size() < 60); // not as many as faces that wait for each other in a row
    if (of_hundred == 2)
      CHECK(groups > wanted.size() / 2); // most are apart

    bool in_order = true;
    for (const local_id f : wanted) {
      std::set<local_id> seen;
      skeleton.for_each_beside(f, [&](local_id other) {
        for (const local_id line : skeleton.sides(other))
          seen.insert(line);
      });
      for (const local_id line : seen)
        for (const local_id other : skeleton.faces_at(line)) // it changes what f looks at
          if (const auto its = turns.find(other); its != turns.end() && other != f) {
            const auto& [first, second] = std::minmax(f, other);
            const turn &a = turns[first], &b = turns[second];
            in_order = in_order && (a.pass < b.pass || (a.group == b.group && a.place < b.place));
          }
    }
    CHECK(in_order);
  }
}

TEST_CASE("a change of lines is seen by its own skeleton alone") {
  two_faces faces({{0, 0, 0}, {3.1, 0, 0}, {2.74, 1.85, 0}, {1.5, -2.6, 0}});
  const std::vector<fine_line> lines(faces.skeleton.lines.size());
  const refined_sizing size(unit_size);
  const auto lines_of_face = lines_of_faces(faces.skeleton);
  const auto faces_of_line = faces_of_lines(lines_of_face, lines.size());
  const detail::matched_skeleton skeleton(faces.points, faces.skeleton, lines, size, 30, lines_of_face,
                                          faces_of_line);
  detail::matched_skeleton changed = skeleton;
  changed.change(no_lines_on_it, 0, {line_segments{3, 0}, {}, {}});
  const local_id line = skeleton.sides(0)[0];
  CHECK(changed.line(line).segments == 3);
  CHECK(changed.points_of(line).size() == 2);
  CHECK(skeleton.line(line).segments == 0);
  CHECK(skeleton.points_of(line).empty());
}
