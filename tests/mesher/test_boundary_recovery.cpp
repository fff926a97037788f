#include "dovetail/mesher/native.hpp"
#include "dovetail/mesher/native/boundary_points.hpp"
#include "dovetail/mesher/native/boundary_recovery.hpp"
#include "dovetail/mesher/native/inside_elements.hpp"
#include "dovetail/mesher/native/interior_points.hpp"
#include "dovetail/triangulation/delaunay.hpp"
#include "mesher/random_pieces.hpp"
#include "mesher/shapes.hpp"
#include "triangulation/triangulation_checks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

struct recovered_piece {
  recovery_counts counts;
  simplicial_mesh<3> mesh;
};

/// Recovers a boundary with no other points than its own, and checks all that is promised.
recovered_piece recover_and_check(const shapes::surface& boundary, const std::vector<vec3>& inner = {}) {
  std::vector<vec3> points = boundary.points;
  append(points, inner);
  detail::append_far_corners(points);
  auto made = triangulate_points<3>(points);
  recovered_piece piece;
  piece.counts = recover_boundary(made.triangulation, boundary_sides(boundary.elements));
  dovetail_test::check_structure(made.triangulation);
  CHECK(made.triangulation.points.size() >= points.size());
  CHECK(std::equal(points.begin(), points.end(), made.triangulation.points.begin()));
  piece.mesh = inside_elements(made.triangulation, boundary_sides(boundary.elements), boundary.points.size());
  piece.mesh.tags.assign(piece.mesh.elements.size(), 3);
  CHECK_NOTHROW(check_mesher_result({boundary, 3}, piece.mesh));
  CHECK(random_pieces::fault_of(boundary, piece.mesh).empty());
  return piece;
}

/// A prism whose upper polygon is turned; its other diagonals lie outside when it is turned backwards.
shapes::surface twisted_prism(int n, double angle) {
  return random_pieces::tower({random_pieces::ring(n, 1, 0, 0), random_pieces::ring(n, 1, angle, 1)});
}

std::vector<vec3> random_directions(std::size_t count, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<vec3> directions(count);
  for (vec3& d : directions)
    for (int k = 0; k < 3; ++k)
      d[k] = unit(engine);
  return directions;
}

} // namespace

TEST_CASE("a boundary that is Delaunay needs nothing") {
  const auto piece = recover_and_check(shapes::sphere(2));
  CHECK(piece.counts.missing_edges == 0);
  CHECK(piece.counts.missing_triangles == 0);
  CHECK(piece.counts.added_points == 0);
}

TEST_CASE("diagonals of squares are turned by flips") {
  for (const auto& boundary : {shapes::cube(5), shapes::cube(4, 1e-3, {1e3, -1e3, 500})}) {
    const auto piece = recover_and_check(boundary);
    CHECK(piece.counts.missing_edges > 0);
    CHECK(piece.counts.splits == 0);
  }
}

TEST_CASE("Schoenhardt's polyhedron gets a point inside") {
  const auto piece = recover_and_check(twisted_prism(3, -0.4));
  CHECK(piece.counts.missing_edges > 0);
  CHECK(piece.counts.added_points > piece.counts.removed_points);
  CHECK(piece.mesh.points.size() == 7); // there must be one, and one is enough
  for (const int n : {4, 5, 7, 9, 12, 20})
    for (const double angle : {-0.2, -0.5, 0.3, -1.5}) {
      if (angle < -2 * (0.9 - 2.0 / n))
        continue; // its sides would meet
      CAPTURE(n);
      CAPTURE(angle);
      recover_and_check(twisted_prism(n, angle));
    }
}

TEST_CASE("rough, flat and sheared surfaces with random points inside are recovered") {
  std::size_t edges = 0, triangles = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    CAPTURE(seed);
    auto boundary = shapes::torus(10);
    const auto directions = random_directions(boundary.points.size(), seed);
    for (std::size_t v = 0; v < directions.size(); ++v)
      boundary.points[v] += 0.03 * directions[v];
    std::vector<vec3> inner; // along the middle of the tube
    for (int i = 0; i < 20; ++i)
      inner.push_back({std::cos(0.3 * i), std::sin(0.3 * i), 0.01 * i - 0.1});
    const auto piece = recover_and_check(boundary, inner);
    edges += piece.counts.missing_edges;
    triangles += piece.counts.missing_triangles;
  }
  CHECK(edges > 0);
  auto flat = shapes::torus(10);
  for (vec3& p : flat.points)
    p.x *= 0.05;
  triangles += recover_and_check(flat).counts.missing_triangles;
  auto sheared = shapes::cube(4);
  for (vec3& p : sheared.points)
    p = {p.x + 0.7 * p.y, p.y, 0.1 * p.z + 0.3 * p.x * p.x};
  recover_and_check(sheared);
  CHECK(triangles > 0);
}

TEST_CASE("a cavity is divided by a triangle that an edge pierces, or left as it is") {
  // A triangle between two points above and below that see each other through it.
  shapes::surface cut;
  cut.points = {{1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {0, 0, 0.2}, {0, 0, -0.2}};
  cut.elements = {{0, 1, 2}, {0, 2, 1}};
  auto points = cut.points;
  detail::append_far_corners(points);
  detail::local_changes changes(triangulate_points<3>(points).triangulation);
  const boundary_sides sides(cut.elements);
  const detail::kept_entities kept(sides);
  const detail::triangle_target target{{0, 1, 2}};
  REQUIRE_FALSE(target.is_there(changes));
  detail::obstacles found;
  detail::find_obstacles(changes, target, found);
  REQUIRE(found.edges == std::vector<std::array<local_id, 2>>{{3, 4}});
  CHECK(found.elements.size() == 3);
  const std::vector<local_id> some(found.elements.begin(), found.elements.begin() + 2);
  CHECK_FALSE(detail::cavity_division(changes, kept, target.corners, some).run());
  CHECK(changes.mesh().points.size() == points.size());
  CHECK(detail::cavity_division(changes, kept, target.corners, found.elements).run());
  CHECK(target.is_there(changes));
  CHECK_FALSE(changes.element_with_edge(3, 4) != no_id);
  dovetail_test::check_structure(changes.mesh());
}

TEST_CASE("what cannot be recovered is named: a triangle through another, a point on an edge or a triangle") {
  auto crossing = shapes::cube(2);
  shapes::append(crossing, shapes::cube(2, 0.8, {0.31, 0.17, -0.43}));
  const auto with_void_at = [](vec3 tip_at) { // a void whose tip is on a side of the cube
    auto touching = shapes::cube(1);
    touching.points.push_back(tip_at);
    const auto tip = static_cast<local_id>(touching.points.size()) - 1;
    for (const vec3 p : {vec3{0.2, 0.2, 0.3}, vec3{0.2, 0.6, 0.3}, vec3{0.6, 0.2, 0.3}})
      touching.points.push_back(p);
    for (const simplex<2>& t : {simplex<2>{tip, tip + 1, tip + 2}, simplex<2>{tip, tip + 2, tip + 3},
                                simplex<2>{tip, tip + 3, tip + 1}, simplex<2>{tip + 1, tip + 3, tip + 2}})
      touching.elements.push_back(t);
    return touching;
  };
  // On the diagonal of the side, and in a triangle of it.
  const auto in_a_triangle = with_void_at({0.3, 0.45, 1});
  {
    auto points = in_a_triangle.points;
    detail::append_far_corners(points);
    auto made = triangulate_points<3>(points);
    CHECK_THROWS_WITH_AS(recover_boundary(made.triangulation, boundary_sides(in_a_triangle.elements)),
                         doctest::Contains("which passes through point (0.3, 0.45, 1)"), mesher_error);
  }
  for (const auto& boundary : {crossing, with_void_at({0.5, 0.5, 1})}) {
    auto points = boundary.points;
    detail::append_far_corners(points);
    auto made = triangulate_points<3>(points);
    CHECK_THROWS_WITH_AS(recover_boundary(made.triangulation, boundary_sides(boundary.elements)),
                         doctest::Contains("could not be recovered: edge ("), mesher_error);
    CHECK_THROWS_WITH_AS(recover_boundary(made.triangulation, boundary_sides(boundary.elements)),
                         doctest::Contains("which passes through"), mesher_error);
  }
}

TEST_CASE("all pieces at random are filled, thin, twisted, rough, touching themselves or with walls inside") {
  double left = 0, removed = 0;
  for (std::size_t family = 0; family < random_pieces::families().size(); ++family)
    for (unsigned seed = 0; seed < 12; ++seed) {
      CAPTURE(random_pieces::families()[family].name);
      CAPTURE(seed);
      const auto piece = random_pieces::make(family, seed);
      const auto result = mesher::native{}({piece.boundary, 0}, [&](vec3) { return piece.size; });
      CHECK(random_pieces::fault_of(piece.boundary, result.mesh) == "");
      left += result.summary.get("recovery_points");
      removed += result.summary.get("recovery_points_removed");
    }
  CHECK(left > 0);
  CHECK(removed > 2 * left);
}

TEST_CASE("pieces that the first attempts fail at are filled by later ones") {
  // A prism and two lanterns: a point stays on the boundary at first, or the work is spent.
  struct number {
    std::size_t family;
    unsigned seed;
  };
  for (const number& of : {number{0, 98}, number{5, 56}, number{5, 631}}) {
    CAPTURE(of.family);
    CAPTURE(of.seed);
    const auto piece = random_pieces::make(of.family, of.seed);
    const any_sizing size = [&](vec3) { return piece.size; };
    auto points = piece.boundary.points;
    append(points, interior_points(piece.boundary, size));
    detail::append_far_corners(points);
    detail::local_changes changes(triangulate_points<3>(points).triangulation);
    const boundary_sides sides(piece.boundary.elements);
    const auto lacking = detail::missing_triangles(changes.mesh(), sides);
    CHECK_THROWS_AS(detail::boundary_recovery(changes, sides, {}).run(lacking), mesher_error);
    const auto result = mesher::native{}({piece.boundary, 0}, size);
    CHECK(random_pieces::fault_of(piece.boundary, result.mesh) == "");
    CHECK(result.summary.get("recovery_operations") < 80'000'000);
  }
}

TEST_CASE("boundaries that pass through themselves are refused, and soon") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const auto boundary = random_pieces::make_crossing(seed);
    CHECK_THROWS_AS(mesher::native{}({boundary, 0}, [](vec3) { return 10.0; }), mesher_error);
  }
  // Nothing is where it should be: what is allowed is spent, in much less than a second per attempt.
  auto hopeless = shapes::sphere(3);
  random_pieces::dice d(1);
  for (vec3& p : hopeless.points)
    p = d.vector();
  auto points = hopeless.points;
  detail::append_far_corners(points);
  const auto made = triangulate_points<3>(points);
  detail::local_changes changes(made.triangulation);
  const boundary_sides sides(hopeless.elements);
  const auto lacking = detail::missing_triangles(changes.mesh(), sides);
  CHECK_THROWS_AS(detail::boundary_recovery(changes, sides, {}).run(lacking), mesher_error);
  CHECK(changes.work() < 30'000'000);
}

TEST_CASE("the point farthest from all planes is found in regions however flat") {
  for (const double height : {1.0, 1e-3, 1e-6, 1e-9}) {
    const std::array<vec3, 4> p{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, height}}};
    std::vector<std::array<vec3, 3>> sides;
    for (const auto& local : numbering::sides<3>)
      sides.push_back({p[local[0]], p[local[1]], p[local[2]]});
    const vec3 middle = detail::point_before_all(sides);
    double least = 1e300, area = 0;
    for (const auto& [a, b, c] : sides) {
      least = std::min(least, dot(normalized(cross(c - a, b - a)), middle - a));
      area += norm(cross(c - a, b - a)) / 2;
    }
    CHECK(least == doctest::Approx(3 * (height / 6) / area).epsilon(1e-5)); // of the inscribed ball
  }
}

TEST_CASE("points added are removed where neighbours can take their place") {
  auto points = shapes::cube(2).points;
  const auto given = static_cast<local_id>(points.size());
  for (int k = 1; k < 6; ++k)
    points.push_back({0.1 * k, 0.13 * k, 0.6 - 0.05 * k});
  detail::append_far_corners(points);
  detail::local_changes changes(triangulate_points<3>(points).triangulation);
  const boundary_sides sides(shapes::cube(2).elements);
  const detail::kept_entities kept(sides);
  detail::point_removal removal(changes, kept);
  for (local_id v = given; v < given + 5; ++v) {
    CHECK(removal.remove(v));
    CHECK_FALSE(changes.is_in_element(v));
  }
  dovetail_test::check_structure(changes.mesh());
}

TEST_CASE("recovery gives the same mesh every time") {
  const auto boundary = twisted_prism(9, -0.5);
  const auto first = recover_and_check(boundary), second = recover_and_check(boundary);
  CHECK(first.mesh.points == second.mesh.points);
  CHECK(first.mesh.elements == second.mesh.elements);
}

TEST_CASE("no boundary, and elements inside of a boundary that is none") {
  auto made = triangulate_points<3>(shapes::cube(2).points);
  const auto before = made.triangulation.cells.size();
  CHECK(recover_boundary(made.triangulation, boundary_sides({})).missing_edges == 0);
  CHECK(made.triangulation.cells.size() == before);
  auto boundary = shapes::cube(2);
  auto points = boundary.points;
  detail::append_far_corners(points);
  made = triangulate_points<3>(points);
  recover_boundary(made.triangulation, boundary_sides(boundary.elements));
  boundary.elements.pop_back(); // open
  CHECK_THROWS_AS(
      inside_elements(made.triangulation, boundary_sides(boundary.elements), boundary.points.size()),
      mesher_error);
  boundary.elements = {{0, 1, 25}}; // no side of an element
  CHECK_THROWS_AS(
      inside_elements(made.triangulation, boundary_sides(boundary.elements), boundary.points.size()),
      mesher_error);
}
