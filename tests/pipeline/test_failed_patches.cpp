#include "dovetail/intersection/crossing_refinement.hpp"
#include "dovetail/pipeline/crossings.hpp"
#include "dovetail/skeleton/segment_matching.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

/// A region of CAD face 9 and one interface face, between subdomains 1 and 2, that ends on it.
coarse_skeleton skeleton() {
  coarse_skeleton coarse;
  coarse.lines = {{{0, 1}, {2, 9}, {}, {}}, {{0, 2}, {3, no_id}, {}, {}}, {{1, 2}, {3, no_id}, {}, {}}};
  coarse.regions = {{9, {1, no_id}, {0}, {}}};
  coarse.faces = {{{0, 1, 2}, {1, 2}}};
  return coarse;
}

patch_failure folded_triangle() {
  patch_failure failure;
  failure.folded = {{vec3{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}};
  failure.reason = "a region of face 9: a triangle stays folded over";
  return failure;
}

} // namespace

TEST_CASE("where a region is folded over its sizes are made smaller, and nothing is merged") {
  patch_failure failure = folded_triangle();
  failure.region = 0;
  const suppression_plan plan = detail::plan_for_failed_patches(skeleton(), {failure});
  CHECK(plan.merges.empty());
  REQUIRE(plan.surface_crossings.size() == 1);
  CHECK(plan.surface_crossings[0].cad_faces == std::array<local_id, 2>{9, 9});
  CHECK(plan.surface_crossings[0].center == vec3{1, 1, 0});
  CHECK(plan.surface_crossings[0].size == doctest::Approx((6 + std::sqrt(18.0)) / 3));
}

TEST_CASE("an interface face that is folded over goes, with its subdomains merged") {
  patch_failure failure = folded_triangle();
  failure.face = 0;
  const suppression_plan plan = detail::plan_for_failed_patches(skeleton(), {failure});
  CHECK(plan.surface_crossings.empty());
  CHECK(plan.merges == std::vector<std::array<local_id, 2>>{{1, 2}});
}

TEST_CASE("lines that cross go with the interfaces on them; without any the face is named") {
  patch_failure failure;
  failure.region = 0;
  failure.reason = "a region of face 9: its boundary lines cross in the parameter plane";
  const suppression_plan none = detail::plan_for_failed_patches(skeleton(), {failure});
  CHECK_FALSE(none.merges_suffice); // an error says so, when finer sizes do not help either
  CHECK(none.lines_at_fault.starts_with(failure.reason));
  CHECK(none.merges.empty());
  failure.removable_lines = {0};
  CHECK(detail::plan_for_failed_patches(skeleton(), {failure}).merges ==
        std::vector<std::array<local_id, 2>>{{1, 2}});
}

TEST_CASE("a face that stays folded over, also when refined, is named") {
  geometry_topology topology;
  topology.faces.resize(2);
  topology.faces[1].name = "blend";
  CHECK_THROWS_WITH_AS(
      throw_crossing_faces(topology, {1, 1}),
      "the surface of face 1 (blend) crosses itself or stays folded over, also when refined; "
      "repair the model there or give a smaller size",
      intersection_error);
}

TEST_CASE("only the lines of what fails on matched lines are as before, or the nearest where none of these "
          "was matched") {
  surface_mesh surface;
  surface.mesh.elements = {{0, 1, 3}};
  coarse_skeleton coarse = skeleton();
  for (const std::array<local_id, 2>& vertices : {std::array{1, 4}, std::array{4, 9}})
    coarse.lines.push_back({vertices, {3, no_id}, {}, {}});
  for (const std::size_t matched : {1U, 3U, 4U})
    coarse.lines[matched].segments = 5, coarse.lines[matched].bias = 0.25;
  const coarse_skeleton before = coarse;
  const auto segments_after = [&](patch_failure failure, std::size_t changed) {
    coarse = before;
    CHECK(unmatch_segments(std::vector{std::move(failure)}, surface, coarse) == changed);
    std::vector<int> segments;
    for (const skeleton_line& line : coarse.lines) {
      segments.push_back(line.segments);
      CHECK(line.bias == (line.segments == 0 ? 0 : 0.25));
    }
    return segments;
  };
  patch_failure of_face, of_region;
  of_face.face = 0;
  of_region.region = 0; // with the points 0, 1 and 3
  CHECK(segments_after(of_face, 1) == std::vector{0, 0, 0, 5, 5});
  CHECK(segments_after(of_region, 2) == std::vector{0, 0, 0, 0, 5}); // one line farther, at 2 and 4
  for (skeleton_line& line : coarse.lines)
    line.segments = 0;
  coarse.lines.push_back({{7, 8}, {3, no_id}, {}, {}}); // to which no line leads
  coarse.lines.back().segments = 5;
  CHECK(unmatch_segments(std::vector{of_face}, surface, coarse) == 0);
  CHECK(coarse.lines.back().segments == 5);
}
