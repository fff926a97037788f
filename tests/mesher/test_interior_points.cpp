#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/mesher/native/interior_points.hpp"
#include "dovetail/mesher/native/near_triangle.hpp"
#include "dovetail/mesher/native/straight_lattice.hpp"
#include "dovetail/mesher/shells.hpp"
#include "dovetail/sizing/graded.hpp"
#include "dovetail/sizing/sources.hpp"
#include "mesher/shapes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

using namespace dovetail;

namespace {

double distance_to(const simplicial_mesh<2>& boundary, vec3 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : boundary.elements) {
    const auto at = [&](std::size_t k) { return boundary.points[t[k]]; };
    const auto w = nearest_on_triangle(at(0), at(1), at(2), p);
    least = std::min(least, distance(w[0] * at(0) + w[1] * at(1) + w[2] * at(2), p));
  }
  return least;
}

/// Inside all shells taken together, by another way than that of the code that is tested.
bool is_inside(const simplicial_mesh<2>& boundary, vec3 p) {
  return winding_number(boundary.points, boundary.elements, p) > 0.5;
}

/// Each of every n-th point is inside, at least `clearance` sizes from the boundary.
void check_clear(const simplicial_mesh<2>& boundary, const any_sizing& size, const std::vector<vec3>& points,
                 double clearance, std::size_t step = 1) {
  std::size_t outside = 0, near = 0;
  for (std::size_t k = 0; k < points.size(); k += step) {
    outside += !is_inside(boundary, points[k]);
    near += distance_to(boundary, points[k]) < clearance * size(points[k]);
  }
  CHECK(outside == 0);
  CHECK(near == 0);
}

/// The least distance between two points, in sizes.
double least_spacing(const std::vector<vec3>& points, const any_sizing& size) {
  const box_tree tree(boxes_of_points(points, [](vec3 p) { return p; }));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double h = size(points[i]);
    tree.for_each([&](const box3& box,
                      std::size_t) { return distance_squared(box, points[i]) < least * least * h * h; },
                  [&](local_id j) {
                    if (static_cast<std::size_t>(j) != i)
                      least = std::min(least, distance(points[i], points[j]) / h);
                  });
  }
  return least;
}

/// The edge, in sizes, of a lattice with as many points in a ball as are there: a body-centred cubic one with
/// cubes of edge a has 2 / a^3 points in a unit of volume and edges of 0.9235 a in the mean.
double mean_edge_by_count(std::size_t points, double integral_of_inverse_cube) {
  return 0.9235 * std::cbrt(2 * integral_of_inverse_cube / static_cast<double>(points));
}

/// Where the lattice is bent, Delaunay edges are 3.5 to 6 % longer at the same density (measured on fields of
/// slopes 0.05 to 0.25).
double bent_mean_edge_by_count(std::size_t points, double integral_of_inverse_cube) {
  return 1.045 * mean_edge_by_count(points, integral_of_inverse_cube);
}

/// The midpoint rule over the points of a fine grid in the ball.
template <class Size>
double integral_in_ball(const Size& size, vec3 center, double radius) {
  constexpr int n = 80;
  const double step = 2 * radius / n;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const vec3 from_center{(i + 0.5) * step - radius, (j + 0.5) * step - radius,
                               (k + 0.5) * step - radius};
        if (norm(from_center) < radius)
          sum += std::pow(step / size(center + from_center), 3);
      }
  return sum;
}
std::size_t count_in_ball(const std::vector<vec3>& points, vec3 center, double radius) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](vec3 p) { return distance(p, center) < radius; }));
}

any_sizing uniform(double h) {
  return [h](vec3) { return h; };
}

/// A ball with a small void in the middle, and sizes that grow away from it.
simplicial_mesh<2> ball_with_void() {
  auto boundary = shapes::sphere(3);
  shapes::append(boundary, shapes::sphere(2, 0.1), true);
  return boundary;
}
double size_around_void(vec3 p) {
  return 0.03 + 0.2 * std::max(0.0, norm(p) - 0.1);
}

} // namespace

TEST_CASE("Points are inside and clear of the boundary") {
  for (const auto& boundary : {shapes::sphere(3), shapes::torus(16), shapes::cube(6)}) {
    const auto size = uniform(0.13);
    const auto points = interior_points(boundary, size);
    CHECK(points.size() > 100);
    check_clear(boundary, size, points, 0.57);
    CHECK(least_spacing(points, size) > 0.68);
  }
}

TEST_CASE("Points are inside and clear of the boundary where sizes vary") {
  const auto boundary = ball_with_void();
  const auto points = interior_points(boundary, size_around_void);
  CHECK(points.size() > 1000);
  check_clear(boundary, size_around_void, points, 0.56); // sizes are interpolated
  CHECK(least_spacing(points, size_around_void) > 0.63);
}

TEST_CASE("Voids stay empty, however small") {
  for (const auto& p : interior_points(ball_with_void(), size_around_void))
    REQUIRE(norm(p) > 0.1);
  auto box = shapes::cube(10, 2, {-1, -1, -1});
  shapes::append(box, shapes::sphere(2, 0.01), true);
  const auto size = [](vec3 p) { return 0.003 + 0.25 * std::max(0.0, norm(p) - 0.01); };
  const auto points = interior_points(box, size);
  CHECK(points.size() > 1000);
  check_clear(box, size, points, 0.5);
}

TEST_CASE("The mean edge is the size on a uniform field") {
  const auto points = interior_points(shapes::sphere(4), uniform(0.06));
  const double integral = 4.0 / 3.0 * std::numbers::pi * std::pow(0.8 / 0.06, 3);
  CHECK(std::abs(mean_edge_by_count(count_in_ball(points, {}, 0.8), integral) - 1) < 0.05);
}

TEST_CASE("The mean edge is the size on graded fields") {
  const auto linear = [](vec3 p) { return 0.05 + 0.03 * (1 + p.x); };
  const auto points = interior_points(shapes::sphere(4), linear);
  CHECK(std::abs(bent_mean_edge_by_count(count_in_ball(points, {}, 0.8), integral_in_ball(linear, {}, 0.8)) -
                 1) < 0.05);
  const auto radial = [](vec3 p) { return 0.02 + 0.15 * norm(p); };
  const auto around = interior_points(shapes::sphere(3), radial);
  CHECK(std::abs(bent_mean_edge_by_count(count_in_ball(around, {}, 0.7), integral_in_ball(radial, {}, 0.7)) -
                 1) < 0.05);
  const graded_size stepped([](vec3 p) { return p.x < 0.3 ? 0.15 : 0.04; }, {{-1, -1, -1}, {1, 1, 1}},
                            {.slope = 0.25, .relative_error = 0.05});
  const auto over_step = interior_points(shapes::sphere(4), stepped);
  CHECK(std::abs(
            bent_mean_edge_by_count(count_in_ball(over_step, {}, 0.75), integral_in_ball(stepped, {}, 0.75)) -
            1) < 0.05);
}

TEST_CASE("A source between the corners of the octree is met when the field tells of it") {
  const source_field size(0.5, {point_source({0.21, 0.13, 0.07}, 0.02, 0.3, 0.01)});
  const auto points = interior_points(shapes::sphere(2), keep_bounds(size));
  CHECK(count_in_ball(points, {0.21, 0.13, 0.07}, 0.03) > 30);
}

TEST_CASE("The same input gives the same points") {
  for (const any_sizing& size : {uniform(0.11), any_sizing(size_around_void)})
    CHECK(interior_points(ball_with_void(), size) == interior_points(ball_with_void(), size));
}

TEST_CASE("Points go with the piece") {
  const vec3 far{8, -16, 4}; // such that no coordinate is rounded much
  for (const bool graded : {false, true}) {
    const any_sizing size = graded ? any_sizing(size_around_void) : uniform(0.11);
    const auto moved_size = [&](vec3 p) { return size(p - far); };
    auto moved = ball_with_void();
    for (vec3& p : moved.points)
      p += far;
    const auto here = interior_points(ball_with_void(), size);
    const auto there = interior_points(moved, moved_size);
    // Sizes at places that differ by rounding may decide otherwise, so a few points are others.
    CHECK(static_cast<double>(there.size()) ==
          doctest::Approx(static_cast<double>(here.size())).epsilon(0.02));
    if (!graded) {
      REQUIRE(there.size() == here.size());
      double worst = 0;
      for (std::size_t k = 0; k < here.size(); ++k)
        worst = std::max(worst, distance(there[k] - far, here[k]));
      CHECK(worst < 1e-12);
    }
  }
}

TEST_CASE("The order of triangles and their corners does not matter") {
  const auto boundary = ball_with_void();
  auto other = boundary;
  std::reverse(other.elements.begin(), other.elements.end());
  for (auto& t : other.elements)
    std::rotate(t.begin(), t.begin() + 1, t.end());
  CHECK(interior_points(other, size_around_void) == interior_points(boundary, size_around_void));
  CHECK(interior_points(other, uniform(0.11)) == interior_points(boundary, uniform(0.11)));
}

TEST_CASE("A piece thinner than the size has no points") {
  const auto slab = shapes::cells(shapes::block({0, 0, 0}, {8, 8, 1}), {1, 1, 0.9});
  CHECK(interior_points(slab, uniform(1)).empty());
  CHECK(interior_points(slab, [](vec3 p) { return 1 + 0.1 * p.x; }).empty());
}

TEST_CASE("Triangles with the piece on both sides, and edges of more than two triangles") {
  auto split = shapes::cube(6); // with a sheet across, listed in both directions
  const auto size = uniform(0.16);
  const auto id = [&](double x, double y, double z) {
    const vec3 p{x / 6, y / 6, z / 6};
    for (std::size_t v = 0; v < split.points.size(); ++v)
      if (distance(split.points[v], p) < 1e-9)
        return static_cast<local_id>(v);
    split.points.push_back(p);
    return static_cast<local_id>(split.points.size() - 1);
  };
  for (int y = 0; y < 6; ++y)
    for (int z = 0; z < 6; ++z)
      for (const simplex<2>& t : {simplex<2>{id(3, y, z), id(3, y + 1, z), id(3, y + 1, z + 1)},
                                  simplex<2>{id(3, y, z), id(3, y + 1, z + 1), id(3, y, z + 1)}}) {
        split.elements.push_back(t);
        split.elements.push_back({t[0], t[2], t[1]});
      }
  const auto points = interior_points(split, size);
  CHECK(points.size() > 100);
  check_clear(split, size, points, 0.57);

  // Two cubes that share an edge.
  const auto touching = shapes::cells(
      shapes::block({0, 0, 0}, {8, 8, 4}, [](int x, int y, int) { return (x < 4) == (y < 4); }), {1, 1, 1});
  const auto in_both = interior_points(touching, uniform(1));
  CHECK(in_both.size() > 40);
  check_clear(touching, uniform(1), in_both, 0.57);
}

TEST_CASE("Bodies that do not touch are all filled") {
  auto two = shapes::sphere(2);
  shapes::append(two, shapes::sphere(2, 1, {5, 0, 0}));
  for (const any_sizing& size : {uniform(0.3), any_sizing([](vec3 p) { return 0.3 + 0.01 * p.x; })}) {
    const auto points = interior_points(two, size);
    CHECK(count_in_ball(points, {0, 0, 0}, 1) > 50);
    CHECK(count_in_ball(points, {5, 0, 0}, 1) > 50);
  }
}

TEST_CASE("A field is asked nothing outside the box of the boundary, and seldom") {
  const auto boundary = shapes::cells(shapes::block({0, 0, 0}, {20, 6, 6}), {0.1, 0.1, 0.1});
  std::size_t calls = 0;
  const auto size = [&](vec3 p) {
    ++calls;
    REQUIRE(contains({{0, 0, 0}, {2.0000001, 0.6000001, 0.6000001}}, p));
    return 0.02 + 0.02 * p.x;
  };
  const auto points = interior_points(boundary, size);
  CHECK(calls < 2 * points.size());
}

TEST_CASE("What is no size is refused") {
  const auto boundary = shapes::sphere(2);
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(interior_points(boundary, uniform(bad)), sizing_error);
    CHECK_THROWS_AS(interior_points(boundary, [bad](vec3 p) { return norm(p) < 0.6 ? bad : 0.2; }),
                    sizing_error);
    const auto& t = boundary.elements[7];
    const auto at = [&](std::size_t k) { return boundary.points[t[k]]; };
    const vec3 middle = (at(0) + at(1) + at(2)) / 3.0;
    CHECK_THROWS_AS(interior_points(boundary, [&](vec3 p) { return distance(p, middle) < 1e-6 ? bad : 0.2; }),
                    sizing_error);
  }
}

TEST_CASE("Sizes that ask for too many points are refused before they are made") {
  CHECK_THROWS_AS(interior_points(shapes::sphere(2), uniform(1e-9)), mesher_error);
  CHECK_THROWS_AS(interior_points(shapes::sphere(2), uniform(1e-300)), mesher_error);
  CHECK_THROWS_AS(interior_points(shapes::sphere(2), uniform(0.05), {.most_points = 100}), mesher_error);
}

TEST_CASE("As many points as are allowed are made, and not one more") {
  const auto cube = shapes::cube(10);
  for (const any_sizing& size : {uniform(0.045), any_sizing([](vec3 p) { return 0.045 + 0.001 * p.x; })}) {
    const auto points = interior_points(cube, size);
    const auto count = static_cast<double>(points.size());
    CHECK(interior_points(cube, size, {.most_points = count}) == points);
    CHECK_THROWS_WITH_AS(interior_points(cube, size, {.most_points = count - 1}),
                         doctest::Contains("points inside; make them larger"), mesher_error);
  }
}

TEST_CASE("Boundaries that enclose nothing are refused") {
  auto open = shapes::sphere(2);
  open.elements.pop_back();
  CHECK_THROWS_AS(interior_points(open, uniform(0.2)), mesher_error);
  simplicial_mesh<2> inwards;
  shapes::append(inwards, shapes::sphere(2), true);
  CHECK_THROWS_AS(interior_points(inwards, uniform(0.2)), mesher_error);
  CHECK_THROWS_AS(interior_points({}, uniform(0.2)), mesher_error);
  auto beyond = shapes::sphere(2);
  beyond.elements[0][0] = 1 << 20;
  CHECK_THROWS_AS(interior_points(beyond, uniform(0.2)), mesher_error);
  auto infinite = shapes::sphere(2);
  infinite.points[0].x = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(interior_points(infinite, uniform(0.2)), mesher_error);
}

TEST_CASE("Pieces of any scale: powers of two change no bit of the fractions") {
  const auto points = interior_points(ball_with_void(), size_around_void);
  CHECK(points.size() > 1000);
  for (const int power : {-200, -40, 40, 200}) {
    const double scale = std::ldexp(1.0, power);
    auto boundary = ball_with_void();
    for (vec3& p : boundary.points)
      p = scale * p;
    CHECK(interior_points(boundary, uniform(0.11 * scale)).size() > 500);
    auto scaled = interior_points(boundary, [&](vec3 p) { return scale * size_around_void(p / scale); });
    for (vec3& p : scaled)
      p = p / scale;
    CHECK(scaled == points);
  }
}

TEST_CASE("On a uniform field the lattice is straight and fits the faces of a box") {
  const double h = 0.118; // a lattice of this size itself ends far from the upper faces
  const auto points = interior_points(shapes::cube(11), uniform(h));
  REQUIRE(points.size() > 500);
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                                 [axis](vec3 p, vec3 q) { return p[axis] < q[axis]; });
    CHECK(std::abs((*low)[axis] - (1 - (*high)[axis])) < 0.01 * h);
    CHECK((*low)[axis] < 0.61 * h);
  }
}

TEST_CASE("Each place of a straight lattice is in one of the boxes that fill a larger one") {
  for (int n = 2; n < 60; ++n)
    for (const double width : {1.0, 0.7, 0.3 * n, 1.0 / 3, 1e-3}) {
      // Places are exactly on the faces between boxes, but for rounding one way or the other.
      const double lower = -width, step = 2 * width / n;
      const vec3 origin{lower, lower, lower}, steps{step, step, step};
      const double inner = std::min(2.0, 0.5 * n) * step;
      for (const double face : {lower + step * (n / 2), std::nextafter(lower + step * (n / 2), 2 * width),
                                std::nextafter(lower + step * (n / 2), -2 * width), lower + inner}) {
        std::vector<vec3> found;
        const auto collect = [&](vec3 p) { found.push_back(p); };
        detail::for_each_lattice_place({origin, {width, width, lower + inner}}, origin, steps, collect);
        const std::size_t in_all = found.size();
        found.clear();
        detail::for_each_lattice_place({origin, {face, width, lower + inner}}, origin, steps, collect);
        detail::for_each_lattice_place({{face, lower, lower}, {width, width, lower + inner}}, origin, steps,
                                       collect);
        CHECK(found.size() == in_all);
      }
    }
}

TEST_CASE("No plane of a straight lattice is doubled or left out") {
  const auto cube = shapes::cube(4, 2, {-1, -1, -1});
  for (int k = 0; k < 60; ++k) {
    const double h = 0.256 + 0.02 * k / 60;
    CAPTURE(h);
    const auto points = interior_points(cube, uniform(h));
    CHECK(least_spacing(points, uniform(h)) > 0.8);
    std::vector<double> heights;
    for (const vec3 p : points)
      heights.push_back(p.z);
    std::sort(heights.begin(), heights.end());
    double largest_gap = 0;
    for (std::size_t i = 1; i < heights.size(); ++i)
      largest_gap = std::max(largest_gap, heights[i] - heights[i - 1]);
    CHECK(largest_gap < 0.6 * h); // planes are half a cell apart
  }
}

TEST_CASE("A straight lattice has each of its places that is clear and inside") {
  // Points are asked about once for several of them, which must not reach across a wall: voids, bodies in
  // them, gaps and plates about as wide as two clearances.
  auto shells = shapes::cube(8, 4);
  shapes::append(shells, shapes::cube(5, 2.5, {0.7, 0.7, 0.7}), true);
  shapes::append(shells, shapes::cube(2, 0.8, {1.6, 1.6, 1.6}));
  std::vector<simplicial_mesh<2>> bodies{shells};
  for (const double gap : {0.2, 0.55, 0.6, 0.7}) {
    auto gapped = shapes::cells(shapes::block({0, 0, 0}, {8, 8, 4}), {0.5, 0.5, 0.5});
    shapes::append(gapped,
                   shapes::cells(shapes::block({0, 0, 0}, {8, 8, 1}), {0.5, 0.5, gap}, {0, 0, 2 + gap}));
    bodies.push_back(gapped);
  }
  const interior_point_options options;
  for (const auto& body : bodies) {
    const any_sizing size = uniform(0.5);
    const detail::piece_octree piece(body, size, options);
    REQUIRE(piece.is_uniform());
    const auto points = detail::straight_lattice(piece, options);
    REQUIRE(points.size() > 100);
    // The same lattice, but all places are asked about, in all leaves.
    const double clearance = options.clearance * 0.5, margin = 1.05 * clearance;
    const box3 within = inflated(piece.bounds(), -margin);
    vec3 step;
    for (int axis = 0; axis < 3; ++axis)
      step[axis] = detail::step_that_fits(0.25 * options.cell, within.upper[axis] - within.lower[axis]);
    std::vector<vec3> expected;
    std::uint64_t places = 0;
    for (std::size_t n = 0; n < piece.tree().leaf_count(); ++n) {
      const std::size_t leaf = piece.tree().leaf(n);
      if (!piece.is_outside(leaf))
        detail::for_each_lattice_place(piece.tree().box(leaf), within.lower, step, [&](vec3 place) {
          const vec3 p = place + 0.5 * options.jitter * detail::scattered_vector(places++);
          if (distance_to(body, p) >= clearance && is_inside(body, p) && piece.is_clear(leaf, p, clearance))
            expected.push_back(p);
        });
    }
    CHECK(points == expected);
  }
}

TEST_CASE("What a triangle forbids, however flat it is and wherever it lies") {
  std::mt19937 engine(3);
  const auto uniform_in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  const double size = 1e-3; // so small that the ball alone counts beyond the clearance
  const any_sizing sizes = [&](vec3) { return size; };
  std::size_t forbidden = 0, allowed = 0, wrong = 0;
  for (const double height : {1.0, 1e-3, 1e-8, 1e-12, 1e-16, 1e-17})
    for (const double offset : {0.0, 1e3})
      for (int k = 0; k < 2000; ++k) {
        const vec3 origin = offset * vec3{1, -0.7, 0.3};
        const vec3 along = normalized(vec3{uniform_in(-1, 1), uniform_in(-1, 1), uniform_in(-1, 1)});
        const vec3 aside = normalized(cross(along, {0.3, 0.5, uniform_in(0.2, 0.9)}));
        // In the order in which the triangle looks at them: rounding is the same then.
        std::array<vec3, 3> at{origin, origin + along,
                               origin + uniform_in(0.1, 0.9) * along + height * aside};
        std::sort(at.begin(), at.end(),
                  [](vec3 p, vec3 q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); });
        const detail::near_triangle triangle(at, sizes);
        const double clearance = uniform_in(0.01, 0.4);
        const vec3 p = origin + uniform_in(-0.6, 1.6) * along + uniform_in(-0.6, 0.6) * aside +
                       uniform_in(-0.6, 0.6) * cross(along, aside);
        const auto w = nearest_on_triangle(at[0], at[1], at[2], p);
        const double away = distance(w[0] * at[0] + w[1] * at[1] + w[2] * at[2], p);
        const bool is_forbidden = triangle.forbids(p, clearance);
        // Nearer than the clearance everything is forbidden; beyond it only what is in the ball.
        wrong += away < clearance * (1 - 1e-9) && !is_forbidden;
        wrong += is_forbidden && !triangle.around().may_forbid(p, clearance);
        wrong += away > 1 && is_forbidden;
        (is_forbidden ? forbidden : allowed) += 1;
      }
  CHECK(wrong == 0);
  CHECK(forbidden > 500);
  CHECK(allowed > 500);
}

TEST_CASE("A needle far too long for its sizes is refused, and sizes far too small for a piece") {
  const auto needle = shapes::cells(shapes::block({0, 0, 0}, {4, 1, 1}), {1e6, 1, 1});
  CHECK_THROWS_WITH_AS(interior_points(needle, uniform(0.2), {.most_points = 1e5}),
                       doctest::Contains("make them larger"), mesher_error);
  auto box = shapes::cube(2, 2, {-1, -1, -1});
  shapes::append(box, shapes::sphere(1, 1e-8), true);
  CHECK_THROWS_WITH_AS(interior_points(box, uniform(0.5)), doctest::Contains("a millionth"), mesher_error);
}

TEST_CASE("A body with a spike much longer than all of it, in sizes that grow along it, asks for little") {
  auto s = shapes::sphere(1);
  s.points.front() = {0.8, 1e4, 0};
  std::size_t asked = 0;
  interior_points(s, [&](vec3 p) {
    ++asked;
    return 0.5 + 0.25 * std::max(p.y, 0.0);
  });
  CHECK(asked < 10'000);
}

TEST_CASE("Triangles much larger and much smaller than the size") {
  const auto coarse = interior_points(shapes::cube(1), uniform(0.1));
  CHECK(coarse.size() > 100);
  check_clear(shapes::cube(1), uniform(0.1), coarse, 0.57);
  const auto fine = shapes::sphere(4);
  const auto graded = interior_points(fine, uniform(0.5)); // from the triangles' own size
  CHECK(graded.size() > 200);
  CHECK(graded.size() < 1000);
  const auto few = interior_points(fine, uniform(0.5), {.steepest = 1e9});
  CHECK(few.size() > 0);
  CHECK(few.size() < 40);
  check_clear(fine, uniform(0.5), few, 0.57);
}
