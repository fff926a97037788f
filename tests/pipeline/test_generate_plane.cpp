#include "plane_meshes.hpp"

#include "dovetail/distributed/processes.hpp"
#include "dovetail/mesher/native_surface.hpp"
#include "dovetail/models/plane/read.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/threads.hpp"
#include "files/scratch_folder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <thread>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

/// A unit square with a hole and a bent line inside.
plane_drawing square_with_hole() {
  plane_drawing drawing;
  drawing.polygons = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "square"},
                      {{{0.3, 0.3}, {0.5, 0.3}, {0.5, 0.6}, {0.3, 0.6}}, "hole"}};
  drawing.lines = {{{{0.6, 0.2}, {0.8, 0.7}, {0.9, 0.8}}, "crack"}};
  return drawing;
}

template <executor E = parallel::serial>
generated<2> mesh_plane(const plane_domain& domain, double size, int parts, E run = {}) {
  return generate<2>(domain, uniform_size(size),
                     parameters<>{}.with_executor(run).with_options(in_parts(parts)));
}

} // namespace

TEST_CASE("a square with a hole and an inner line: area, hole and line are kept") {
  const auto result = mesh_plane(plane_domain(square_with_hole()), 0.03, 5);
  const auto mesh = require_valid(result);
  CHECK(result.mesh.counts.size() == 5);
  CHECK(area_of(mesh) == doctest::Approx(1 - 0.2 * 0.3).epsilon(1e-12));
  CHECK(euler_characteristic(mesh) == 0);
  CHECK(result.quality.min_dihedral_deg > 25);
  CHECK(static_cast<double>(result.quality.elements) ==
        doctest::Approx(result.plan.predicted_elements).epsilon(0.1));
  double along_line = 0;
  const auto& skeleton = result.mesh.skeleton;
  for (std::size_t e = 0; e < skeleton.sides.size(); ++e)
    if (const auto [a, b] = skeleton.sides[e];
        skeleton.side_hosts[e] >= 8) // the square and the hole have eight
      along_line += distance(skeleton.points[a], skeleton.points[b]);
  CHECK(along_line == doctest::Approx(std::hypot(0.2, 0.5) + std::hypot(0.1, 0.1)));
}

TEST_CASE("how heavy a super-element may become is an option") {
  const auto heaviest = [](contraction_bound bound) {
    auto options = in_parts(5);
    options.super_elements = bound;
    const auto result = generate<2>(
        plane_domain(square_with_hole()), uniform_size(0.03),
        parameters<>{}
            .with_simplifier(simplifier::paper{.surface_dihedral_deg = 70, .surface_shape_deg = 50})
            .with_options(options));
    return result.summary.find("simplification").get("heaviest_super_element");
  };
  const double usual = heaviest({});
  CHECK(heaviest({.fraction = 0.02, .always_allowed_elements = 2}) < 0.5 * usual);
  CHECK(heaviest({.subdomains = 1000}) == usual); // these are those of the mesh
}

TEST_CASE("cut lines meet no small corners, coarse and fine") {
  const auto result = mesh_plane(plane_domain(square_with_hole()), 0.02, 8);
  CHECK(result.coarse_angles.interface_faces > 10);
  CHECK(result.coarse_angles.violations.empty());
  CHECK(result.fine_angles.min_dihedral_deg() > 49);
  std::size_t between_subdomains = 0;
  const auto& skeleton = result.mesh.skeleton;
  for (std::size_t e = 0; e < skeleton.sides.size(); ++e)
    between_subdomains += skeleton.side_hosts[e] == no_id && skeleton.subdomains[e][1] != no_id ? 1 : 0;
  CHECK(result.fine_angles.interface_faces == between_subdomains);
  CHECK(between_subdomains > result.coarse_angles.interface_faces);
}

namespace {

/// Fails on the piece at a corner of the square as long as its boundary is short.
struct fails_on_a_small_corner : mesher::native_surface {
  mesher_result<2> operator()(const mesher_input<2>& input, const any_sizing& size) const {
    const auto& points = input.boundary.points;
    if (std::find(points.begin(), points.end(), vec3{0, 0, 0}) != points.end() &&
        points.size() < longest_that_fails)
      throw mesher_error("the corner piece is too small for this mesher");
    return mesher::native_surface::operator()(input, size);
  }
  std::size_t longest_that_fails = 0;
};

} // namespace

TEST_CASE("a piece that fails is merged with its neighbour, and others are found again") {
  const plane_domain domain(square_with_hole());
  std::size_t points_of_corner = 0;
  const auto plain = mesh_plane(domain, 0.03, 6);
  for (std::size_t p = 0; p < plain.mesh.counts.size(); ++p) {
    const auto piece = plain.mesh.load(static_cast<local_id>(p));
    const auto& points = piece.mesh.points;
    if (std::find(points.begin(), points.end(), vec3{0, 0, 0}) != points.end())
      points_of_corner = piece.skeleton_points.size();
  }
  REQUIRE(points_of_corner > 0);
  fails_on_a_small_corner mesher;
  mesher.longest_that_fails = points_of_corner + 1;
  const auto result =
      generate<2>(domain, uniform_size(0.03), parameters<>{}.with_mesher(mesher).with_options(in_parts(6)));
  const auto mesh = require_valid(result);
  CHECK(area_of(mesh) == doctest::Approx(1 - 0.2 * 0.3).epsilon(1e-12));
  CHECK(result.mesh.counts.size() == 5);
  const report& meshing = result.summary.children.back();
  CHECK(result.summary.find("intersection").get("merged_after_failure") == 1);
  // One more is made again: its region and the merged one are beside the same curves, and which of two
  // regions may have a chord between points of both goes by their order.
  CHECK(meshing.get("reused") == 3);
}

namespace {

bool has_corner(const simplicial_mesh<2>& mesh) {
  return std::find(mesh.points.begin(), mesh.points.end(), vec3{0, 0, 0}) != mesh.points.end();
}

/// Its time is over at the corner of the square, as if it ran in a process of its own.
struct late_at_the_corner : improvement::native {
  report operator()(simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen,
                    const any_sizing& size) const {
    if (has_corner(mesh))
      throw time_limit_error("exceeded the time limit");
    return improvement::native::operator()(mesh, frozen, size);
  }
};

/// Does not come back from the corner, the first time that it is asked.
struct stuck_at_the_corner : mesher::native_surface {
  mesher_result<2> operator()(const mesher_input<2>& input, const any_sizing& size) const {
    auto made = mesher::native_surface::operator()(input, size);
    if (has_corner(made.mesh) && !std::filesystem::exists(mark)) {
      std::ofstream{mark};
      std::this_thread::sleep_for(std::chrono::hours(1));
    }
    return made;
  }
  std::filesystem::path mark = {};
};

} // namespace

TEST_CASE("what a limit of time has decided is counted, and is remembered with the piece") {
  const plane_domain domain(square_with_hole());
  const scratch_folder folder("clock");
  const auto given = parameters<>{}.with_options(in_parts(5));
  CHECK(stops_by_clock(generate<2>(domain, uniform_size(0.05), given).summary) == 0);
  const auto late =
      given.with_improver(late_at_the_corner{})
          .with_executor(parallel::checkpointed(parallel::serial{}, spool::start(folder / "spool", {})));
  for (const int reused : {0, 5}) {
    const auto result = generate<2>(domain, uniform_size(0.05), late);
    CHECK(stops_by_clock(result.summary) == 1);
    CHECK(result.summary.children.back().get("reused") == reused);
  }
}

TEST_CASE("a piece that does not come back is ended, meshed again, and counted") {
  const plane_domain domain(square_with_hole());
  const scratch_folder folder("clock");
  stuck_at_the_corner stuck;
  stuck.mark = folder / "stuck";
  auto given =
      parameters<>{}.with_mesher(stuck).with_executor(parallel::processes{2}).with_options(in_parts(5));
  given.options.limit_seconds = 3;
  const auto result = generate<2>(domain, uniform_size(0.05), given);
  require_valid(result);
  CHECK(result.mesh.counts.size() == 5);
  CHECK(stops_by_clock(result.summary) == 1);
}

TEST_CASE("the plane mesh is the same for every executor and number of workers") {
  const plane_domain domain(square_with_hole());
  const auto expected = io::mesh_hash(mesh_plane(domain, 0.02, 6).mesh);
  for (const int workers : {1, 2, 4}) {
    CHECK(io::mesh_hash(mesh_plane(domain, 0.02, 6, parallel::processes{.worker_count = workers}).mesh) ==
          expected);
    CHECK(io::mesh_hash(mesh_plane(domain, 0.02, 6, parallel::threads{.worker_count = workers}).mesh) ==
          expected);
  }
  CHECK(io::mesh_hash(mesh_plane(domain, 0.02, 7).mesh) != expected);
}

TEST_CASE("an L, and an annulus whose curves have no corners") {
  const auto l = require_valid(
      mesh_plane(plane_domain({{{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, "L"}}, {}}), 0.06, 4));
  CHECK(area_of(l) == doctest::Approx(3).epsilon(1e-12));
  CHECK(euler_characteristic(l) == 1);

  const auto annulus =
      require_valid(mesh_plane(plane_domain(drawing_from_svg_path("M2,0 A2 2 0 1 1 -2 0 A2 2 0 1 1 2 0 Z "
                                                                  "m-1 0 a1,1 0 1 0 -2 0 a1,1 0 1 0 2 0 z")),
                               0.08, 6));
  CHECK(area_of(annulus) == doctest::Approx(3 * std::numbers::pi).epsilon(2e-3));
  CHECK(euler_characteristic(annulus) == 0);
}

TEST_CASE("an island in a hole, and a line from boundary to boundary") {
  plane_drawing drawing;
  const auto square = [](double from, double to) {
    return plane_path{{{from, from}, {to, from}, {to, to}, {from, to}}};
  };
  drawing.polygons = {square(0, 6), square(1, 5), square(2, 4)};
  drawing.lines = {{{{2, 2}, {4, 4}}}};
  const auto result = mesh_plane(plane_domain(drawing), 0.3, 6);
  const auto mesh = require_valid(result);
  CHECK(area_of(mesh) == doctest::Approx(36 - 16 + 4).epsilon(1e-12));
  CHECK(euler_characteristic(mesh) == 0 + 1);
}

TEST_CASE("sizes are graded as the field says") {
  const plane_domain domain({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, {}});
  const auto field = [](vec3 p) { return 0.01 + 0.05 * p.x; };
  const auto result = generate<2>(domain, any_sizing(field), parameters<>{}.with_options(in_parts(4)));
  const auto mesh = require_valid(result);
  double relative = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const vec3 p = mesh.points.at(a), q = mesh.points.at(b);
    relative += distance(p, q) / field(0.5 * (p + q)) / static_cast<double>(mesh.triangles.size());
  }
  CHECK(relative == doctest::Approx(1).epsilon(0.08));
}

TEST_CASE("bad drawings are refused by name") {
  const auto refused = [](const plane_drawing& drawing, const char* text) {
    CHECK_THROWS_WITH_AS(plane_domain{drawing}, doctest::Contains(text), geometry_error);
  };
  const plane_path good{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "good"};
  refused({{{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, "bow"}}, {}}, "polygon 0 'bow' crosses itself");
  refused({{{{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, "twice"}}, {}}, "polygon 0 'twice': points 1 and 2");
  refused({{{{{0, 0}, {1, 0}}, "flat"}}, {}}, "polygon 0 'flat' has 2 points");
  refused({{good}, {{{{2, 2}, {3, 3}}, "far"}}}, "line 0 'far' lies outside");
  refused({{good}, {{{{0.5, 0.5}, {3, 3}}, "through"}}}, "line 0 'through' meet");
  refused({{}, {}}, "at least one polygon");
  CHECK_THROWS_AS(drawing_from_svg_path("M0 0 L1 0 L1 1"), geometry_error); // open
  CHECK_THROWS_AS(drawing_from_svg_path("M0 0 L1 0 K1 1 Z"), input_error);
  CHECK_THROWS_AS(drawing_from_svg_path("M0 0 L1 z"), input_error);
}

TEST_CASE("an SVG path: upper and lower case, curves within the chord error") {
  const auto square = drawing_from_svg_path("m1,1h2v2H1z").polygons.at(0).points;
  CHECK(square == std::vector<vec2>{{1, 1}, {3, 1}, {3, 3}, {1, 3}});
  const auto area = [](const plane_drawing& drawing) {
    return std::abs(dovetail::detail::signed_area(drawing.polygons.at(0).points));
  };
  CHECK(area(drawing_from_svg_path("M-1 0A1 1 0 0 1 1 0A1 1 0 01-1 0Z")) ==
        doctest::Approx(std::numbers::pi).epsilon(1e-3));
  CHECK(area(drawing_from_svg_path("M0 0Q1 2 2 0Z")) == doctest::Approx(4.0 / 3).epsilon(1e-3));
  CHECK(area(drawing_from_svg_path("M0 0c0 1 1 1 1 0z")) == doctest::Approx(0.6).epsilon(1e-3));
}
