#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/skeleton/line_skeleton.hpp"
#include "dovetail/skeleton/remesh_lines.hpp"
#include "dovetail/skeleton/remesh_skeleton.hpp"
#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace dovetail;

namespace {

const any_geometry square(plane_domain({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, {}}));
constexpr double size_of_triangles = 0.005;

/// A strip of interface faces between subdomains 0 and 1: so fine that they are put together in several
/// tasks.
fine_skeleton strip(const any_executor& run) {
  const std::vector<vec3> points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0.5}};
  coarse_skeleton coarse;
  for (const auto& [a, b] : {simplex<1>{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}, {2, 4}, {3, 4}})
    coarse.lines.push_back({{a, b}, {3, no_id}, {}, {}});
  coarse.faces = {{{0, 2, 1}, {0, 1}}, {{1, 2, 3}, {0, 1}}, {{2, 4, 3}, {1, 0}}};
  const refined_sizing size{any_sizing([](vec3) { return size_of_triangles; })};
  memo<fine_line> made_lines(run, "skeleton");
  region_memo made_patches{{run, "skeleton"}};
  const numbered_lines lines =
      number_lines(coarse, remesh_lines(square, coarse.lines, points, size, run, made_lines), points, {});
  const surface_mesh no_surface;
  const std::vector<local_id> materials{7, 7};
  const skeleton_to_remesh of{square, no_surface, points, coarse, lines, size, materials};
  return remesh_skeleton(of, any_surface_mesher(), run, made_patches).fine;
}

void check_same(const fine_skeleton& one, const fine_skeleton& other) {
  CHECK(one.points == other.points);
  CHECK(one.point_hosts == other.point_hosts);
  CHECK(one.sides == other.sides);
  CHECK(one.subdomains == other.subdomains);
  CHECK(one.side_hosts == other.side_hosts);
}

} // namespace

TEST_CASE("Patches fit together, and what lies inside has the solid of the subdomains beside it") {
  const fine_skeleton alone = strip(parallel::serial{});
  REQUIRE(alone.sides.size() > 2 << 16);
  CHECK(alone.point_hosts.size() == alone.points.size());
  CHECK(std::all_of(alone.point_hosts.begin(), alone.point_hosts.end(), [](const host& on) {
    return on == host{3, 7};
  }));
  CHECK(std::all_of(alone.side_hosts.begin(), alone.side_hosts.end(), [](local_id f) { return f == no_id; }));
  // Each corner is the point that is meant: no side is longer than neighbours are apart.
  double area = 0, longest = 0;
  bool in_order = true;
  for (std::size_t s = 0; s < alone.sides.size(); ++s) {
    const auto [a, b, c] = alone.sides[s];
    const auto at = [&](local_id v) { return alone.points[v]; };
    area += 0.5 * norm(cross(at(b) - at(a), at(c) - at(a)));
    longest = std::max({longest, distance(at(a), at(b)), distance(at(b), at(c)), distance(at(c), at(a))});
    const bool in_third = (at(a).x + at(b).x + at(c).x) / 3 > 1;
    in_order = in_order && alone.subdomains[s] == (in_third ? std::array{1, 0} : std::array{0, 1});
  }
  CHECK(in_order);
  CHECK(area == doctest::Approx(1 + 0.5 * std::sqrt(1.25)));
  CHECK(longest < 3 * size_of_triangles);
}

TEST_CASE("Whoever puts patches together, they are in the same order") {
  const fine_skeleton alone = strip(parallel::serial{});
  for (const any_executor& run : {any_executor(parallel::threads{2}), any_executor(parallel::processes{2})})
    check_same(strip(run), alone);
  const testing::scratch_folder scratch("skeleton_assembly");
  const auto disk = spool::start(scratch / "spool", {});
  parallel::run_ranks(2, [&](parallel::in_process& mine) {
    check_same(strip(parallel::checkpointed(parallel::ranks(mine), disk)), alone);
  });
}
