#include "dovetail/mesh/quality.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/skeleton/segment_matching.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

using namespace dovetail;

namespace {

const any_geometry no_lines_on_it(plane_domain({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, {}}));
const any_sizing unit_size = [](vec3) { return 1.0; };

/// Two interface faces inside a domain, one on either side of the line (0, 1).
struct two_faces {
  std::vector<vec3> points;
  coarse_skeleton skeleton;
  std::size_t matched = 0; ///< lines, by the last `remesh`
  matched_faces made_segments{std::make_shared<entity_store>()};
  progress on_progress = {}; ///< of the matching

  explicit two_faces(std::vector<vec3> corners) : points(std::move(corners)) {
    for (const auto& [a, b] : {simplex<1>{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}})
      skeleton.lines.push_back({{a, b}, {3, no_id}, {}, {}});
    skeleton.faces = {{{0, 1, 2}, {0, 1}}, {{0, 3, 1}, {0, 1}}};
  }

  remeshed_skeleton remesh(double least_angle_deg) {
    const auto store = std::make_shared<entity_store>();
    batched_entities<fine_line> made_lines(store);
    region_store made_patches(store);
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
    matched =
        match_segments(no_lines_on_it, points, skeleton, lines.lines,
                       faces_with_small_angles(patches, skeleton, made_patches, least_angle_deg), size,
                       least_angle_deg, any_surface_mesher(), parallel::serial{}, made_segments, on_progress);
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

TEST_CASE("a request to stop ends the matching") {
  two_faces faces({{0, 0, 0}, {3.1, 0, 0}, {2.74, 1.85, 0}, {1.5, -2.6, 0}});
  faces.on_progress.stop_requested = [] { return true; };
  CHECK_THROWS_AS(faces.remesh(30), cancelled);
}
