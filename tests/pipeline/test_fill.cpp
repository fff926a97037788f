#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/parallel/remembering.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/pipeline/fill.hpp"
#include "dovetail/sizing/sources.hpp"
#include "mesher/shapes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

using triangle_mesh = simplicial_mesh<2>;

void turn_over(triangle_mesh& s, std::size_t triangle) {
  std::swap(s.elements[triangle][1], s.elements[triangle][2]);
}

/// Joins points at one place and leaves one of equal triangles.
triangle_mesh joined(const triangle_mesh& s) {
  triangle_mesh result;
  const auto same = [](vec3 a, vec3 b) { return distance(a, b) < 1e-9; };
  std::vector<local_id> number;
  for (const vec3 p : s.points) {
    const auto place =
        std::find_if(result.points.begin(), result.points.end(), [&](vec3 q) { return same(p, q); });
    number.push_back(static_cast<local_id>(place - result.points.begin()));
    if (place == result.points.end())
      result.points.push_back(p);
  }
  std::vector<simplex<2>> known;
  for (simplex<2> t : s.elements) {
    for (local_id& v : t)
      v = number[v];
    if (std::find(known.begin(), known.end(), sorted_vertices(t)) != known.end())
      continue;
    known.push_back(sorted_vertices(t));
    result.elements.push_back(t);
  }
  return result;
}

/// Two cubes side by side, with one wall between them.
triangle_mesh two_rooms() {
  triangle_mesh s = shapes::cube(3);
  shapes::append(s, shapes::cube(3, 1, {1, 0, 0}));
  return joined(s);
}

/// Points bit for bit, each triangle a side with elements where materials are said to be, elements positive
/// and as large as what they fill.
void check_filled(const triangle_mesh& given, const filled_surface& made, double volume) {
  const simplicial_mesh<3>& mesh = made.mesh;
  REQUIRE(mesh.points.size() >= given.points.size());
  CHECK(std::memcmp(mesh.points.data(), given.points.data(), given.points.size() * sizeof(vec3)) == 0);
  REQUIRE(mesh.tags.size() == mesh.elements.size());
  std::vector<simplex<2>> keys;
  std::vector<std::vector<local_id>> expected, found;
  for (std::size_t t = 0; t < given.elements.size(); ++t)
    keys.push_back(sorted_vertices(given.elements[t]));
  std::vector<std::size_t> order(keys.size());
  for (std::size_t t = 0; t < order.size(); ++t)
    order[t] = t;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  found.resize(keys.size());
  double sum = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& v = mesh.elements[e];
    const auto at = [&](std::size_t k) { return mesh.points[v[k]]; };
    const double part = signed_volume(at(0), at(1), at(2), at(3));
    CHECK_MESSAGE(part > 0, "element ", e);
    sum += part;
    for (const auto& local : numbering::sides<3>) {
      const auto key = sorted_vertices(detail::pick(v, local));
      const auto place = std::lower_bound(order.begin(), order.end(), key,
                                          [&](std::size_t t, const auto& k) { return keys[t] < k; });
      if (place != order.end() && keys[*place] == key)
        found[*place].push_back(mesh.tags[e]);
    }
  }
  CHECK(sum == doctest::Approx(volume).epsilon(1e-9));
  double of_regions = 0;
  for (const filled_region& region : made.regions)
    of_regions += region.volume;
  CHECK(of_regions == doctest::Approx(volume).epsilon(1e-9));
  REQUIRE(made.materials_beside.size() == keys.size());
  for (std::size_t t = 0; t < keys.size(); ++t) {
    std::vector<local_id> said;
    for (const local_id material : made.materials_beside[t])
      if (material != no_id)
        said.push_back(material);
    std::sort(said.begin(), said.end());
    std::sort(found[t].begin(), found[t].end());
    CHECK_MESSAGE(found[t] == said, "triangle ", t);
    CHECK(!said.empty());
  }
}

double inside(const triangle_mesh& s) {
  return enclosed_volume(span_of(s.points), span_of(s.elements));
}

template <class Error>
void check_refused(const triangle_mesh& s, const char* text, const fill_options& options = {}) {
  CHECK_THROWS_WITH_AS(fill(s, options), doctest::Contains(text), Error);
}

struct failing {
  static constexpr mesher_traits traits{.keeps_boundary = true};
  mesher_result<3> operator()(const mesher_input<3>&, const any_sizing&) const {
    throw mesher_error("not today");
  }
};

} // namespace

TEST_CASE("a needle that a rough prediction misses is refused before it is meshed") {
  auto s = shapes::cube(2);
  s.points.front() = {-1e8, 0, 0};
  fill_options options;
  options.largest_prediction = 5000;
  CHECK_THROWS_WITH_AS(fill(
                           s, [](vec3) { return 0.2; }, options),
                       doctest::Contains("the sizes predict"), sizing_error);
}

TEST_CASE("a small source between the samples of a rough prediction is refused before it is meshed") {
  fill_options options;
  options.largest_prediction = 100'000;
  const source_field size(0.3, {point_source({0.51, 0.52, 0.48}, 1e-4, 0.02, 1e-4)});
  CHECK_THROWS_WITH_AS(fill(shapes::cube(4), size, options, failing{}),
                       doctest::Contains("the sizes predict"), sizing_error);
}

TEST_CASE("a cube is filled in sizes of its own, the same by any executor") {
  const triangle_mesh cube = shapes::cube(6);
  const auto made = fill(cube);
  check_filled(cube, made, 1);
  CHECK(made.regions.size() == 1);
  CHECK(made.summary.get("voids") == 0);
  CHECK(made.summary.warnings.empty());
  CHECK(made.quality.min_dihedral_deg > 20);
  fill_options threads;
  threads.run_regions = parallel::threads{.worker_count = 2};
  const auto again = fill(cube, threads);
  CHECK(again.mesh.elements == made.mesh.elements);
  CHECK(again.mesh.points == made.mesh.points);
}

TEST_CASE("a shell oriented inwards is a void, one oriented outwards a body in the body") {
  for (const bool is_void : {true, false}) {
    triangle_mesh s = shapes::cube(6);
    const triangle_mesh ball = shapes::sphere(2, 0.25, {0.5, 0.5, 0.5});
    shapes::append(s, ball, is_void);
    const auto made = fill(s);
    check_filled(s, made, is_void ? 1 - inside(ball) : 1);
    CHECK(made.regions.size() == (is_void ? 1 : 2));
    CHECK(made.summary.get("voids") == (is_void ? 1 : 0));
    CHECK(made.summary.warnings.empty());
  }
}

TEST_CASE("bodies in voids of bodies, and bodies beside each other") {
  triangle_mesh s = shapes::cube(4, 4);
  shapes::append(s, shapes::cube(3, 3, {0.5, 0.5, 0.5}), true);
  shapes::append(s, shapes::cube(2, 2, {1, 1, 1}));
  shapes::append(s, shapes::cube(2, 1, {1.5, 1.5, 1.5}), true);
  shapes::append(s, shapes::cube(2, 1, {9, 0, 0}));
  shapes::append(s, shapes::cube(2, 0.25, {1.75, 1.75, 1.75}));
  const auto made = fill(s);
  check_filled(s, made, 64 - 27 + 8 - 1 + 1 + 1.0 / 64);
  CHECK(made.regions.size() == 4);
  CHECK(made.summary.get("voids") == 2);
}

TEST_CASE("an inner wall divides a box into two materials, whatever its orientation") {
  triangle_mesh s = two_rooms();
  for (const bool turned : {false, true}) {
    const auto made = fill(s);
    check_filled(s, made, 2);
    REQUIRE(made.regions.size() == 2);
    CHECK(made.regions[0].material == 0);
    CHECK(made.regions[1].material == 1);
    CHECK(made.regions[0].volume == doctest::Approx(1));
    CHECK(made.summary.warnings.empty());
    if (!turned)
      for (std::size_t t = 0; t < s.elements.size(); ++t)
        if (made.materials_beside[t][0] != no_id && made.materials_beside[t][1] != no_id)
          turn_over(s, t);
  }
}

TEST_CASE("a wall with one region on both sides has elements on both") {
  // A ring with a square across it.
  triangle_mesh s = shapes::cells(
      shapes::block({0, 0, 0}, {3, 3, 1}, [](int x, int y, int) { return x != 1 || y != 1; }), {1, 1, 1});
  const auto corner = [&](double y, double z) {
    const auto place = std::find(s.points.begin(), s.points.end(), vec3{1, y, z});
    REQUIRE(place != s.points.end());
    return static_cast<local_id>(place - s.points.begin());
  };
  const local_id a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
  s.elements.push_back({a, b, c});
  s.elements.push_back({a, c, d});
  const auto made = fill(s);
  check_filled(s, made, 8);
  CHECK(made.regions.size() == 1);
  CHECK(made.materials_beside.back() == std::array<local_id, 2>{0, 0});
}

TEST_CASE("regions of a body that touch in edges and points") {
  const triangle_mesh s = shapes::cells({{0, 0, 0}, {1, 1, 0}, {2, 2, 1}}, {1, 1, 1});
  const auto made = fill(s);
  check_filled(s, made, 3);
  CHECK(made.regions.size() == 3);
}

TEST_CASE("where orientations mean nothing all that is enclosed is filled, with a warning") {
  triangle_mesh inside_out = shapes::cube(4), mixed = shapes::cube(4);
  shapes::append(mixed, shapes::sphere(1, 0.25, {0.5, 0.5, 0.5}), true);
  for (std::size_t t = 0; t < inside_out.elements.size(); ++t)
    turn_over(inside_out, t);
  for (std::size_t t = 0; t < mixed.elements.size(); t += 3)
    turn_over(mixed, t);
  for (const triangle_mesh& s : {inside_out, mixed}) {
    const auto made = fill(s);
    check_filled(s, made, 1);
    REQUIRE(made.summary.warnings.size() == 1);
    CHECK(made.summary.warnings[0].find("all that is enclosed is filled") != std::string::npos);
  }
}

TEST_CASE("marks name materials and voids") {
  triangle_mesh s = shapes::cube(4);
  shapes::append(s, shapes::cube(2, 0.5, {0.25, 0.25, 0.25}));
  fill_options options;
  options.marks = {{{0.5, 0.5, 0.5}, no_id}};
  const auto hollow = fill(s, options);
  check_filled(s, hollow, 1 - 0.125);
  options.marks = {{{0.5, 0.5, 0.5}, 0}};
  const auto named = fill(s, options);
  check_filled(s, named, 1);
  REQUIRE(named.regions.size() == 2);
  CHECK(named.regions[0].material == 1); // 0 is taken
  CHECK(named.regions[1].material == 0);
  CHECK(named.regions[1].volume == doctest::Approx(0.125));
  options.marks = {{{2, 0, 0}, 0}};
  check_refused<geometry_error>(s, "outside of the surface", options);
  options.marks = {{{0.5, 0.5, 0.5}, -2}};
  check_refused<geometry_error>(s, "the material -2 of the point", options);
  options.marks = {{{0.4, 0.5, 0.5}, 0}, {{0.5, 0.5, 0.5}, 1}};
  check_refused<geometry_error>(s, "say different things", options);
  options.marks = {{{0.5, 0.5, 0.5}, no_id}, {{0.1, 0.1, 0.1}, no_id}};
  check_refused<geometry_error>(s, "elements on neither side", options);
}

TEST_CASE("points that no triangle uses stay where they are") {
  triangle_mesh s = shapes::cube(3);
  s.points.insert(s.points.begin() + 5, {9, 9, 9});
  for (auto& t : s.elements)
    for (local_id& v : t)
      v += v >= 5 ? 1 : 0;
  check_filled(s, fill(s), 1);
}

TEST_CASE("a coarse surface with small sizes, a fine one with large sizes") {
  const triangle_mesh coarse = shapes::cube(2);
  const auto fine_inside = fill(coarse, [](vec3) { return 0.125; });
  check_filled(coarse, fine_inside, 1);
  CHECK(fine_inside.mesh.elements.size() > 1500);

  const triangle_mesh fine = shapes::sphere(3);
  const auto coarse_inside = fill(fine, [](vec3) { return 1.0; });
  check_filled(fine, coarse_inside, inside(fine));
  CHECK(coarse_inside.quality.min_dihedral_deg > 20);
  const auto uniform = fill(fine, [&](vec3) { return shapes::mean_edge(fine); });
  CHECK(uniform.mesh.elements.size() > coarse_inside.mesh.elements.size());
  fill_options faster;
  faster.growth = 0.5;
  CHECK(fill(fine, faster).mesh.elements.size() < fill(fine).mesh.elements.size());
}

TEST_CASE("an executor that remembers is not asked for a fill in other sizes") {
  const triangle_mesh cube = shapes::cube(2);
  fill_options options;
  options.run_regions = parallel::remembering(parallel::serial{});
  const auto elements_of = [&](double size) {
    return fill(
               cube, [size](vec3) { return size; }, options)
        .mesh.elements.size();
  };
  CHECK(elements_of(0.125) > 2 * elements_of(1));
}

TEST_CASE("the policies are the caller's") {
  const triangle_mesh cube = shapes::cube(3);
  const auto plain = fill(cube, {}, mesher::native{.size_scale = 0.5}, no_improver{});
  check_filled(cube, plain, 1);
  CHECK(plain.mesh.elements.size() > fill(cube).mesh.elements.size());
  CHECK_THROWS_WITH_AS(fill(cube, {}, failing{}), doctest::Contains("the inside could not be meshed"),
                       mesher_error);
  CHECK_THROWS_WITH_AS(fill(two_rooms(), {}, failing{}), doctest::Contains("2 of 2 regions"), mesher_error);
}

TEST_CASE("each fault of a surface is named with its place") {
  const triangle_mesh cube = shapes::cube(3);
  triangle_mesh s = cube;
  s.elements.clear();
  check_refused<geometry_error>(s, "without triangles");
  s = cube;
  s.elements[4][1] = 1000;
  check_refused<geometry_error>(s, "triangle 4 refers to point 1000");
  s = cube;
  s.points[7].y = std::nan("");
  check_refused<geometry_error>(s, "point 7 is at");
  s = cube;
  shapes::append(s, shapes::cube(3, 1, {1, 0, 0}));
  check_refused<geometry_error>(s, "each at one place; make them one");
  s = cube;
  s.elements.push_back({s.elements[0][0], s.elements[0][1], s.elements[0][1]});
  check_refused<geometry_error>(s, "a triangle has no area");
  s = cube;
  s.elements.push_back({s.elements[5][1], s.elements[5][0], s.elements[5][2]});
  check_refused<geometry_error>(s, "a triangle is there more than once; leave one of each: 5 at (");
  s = cube;
  s.elements.erase(s.elements.begin() + 10);
  check_refused<geometry_error>(s, "3 edges have one triangle only: the surface is open; close it: from (");
  s = cube;
  shapes::append(s, shapes::cube(2, 1, {0.5, 0.4, 0.3}));
  check_refused<geometry_error>(s, "pairs of triangles cross; cut them along their intersection");
  s = cube;
  s.points.push_back({0.5, 0.5, 2});
  s.points.push_back({0.6, 0.5, 2});
  const auto v = static_cast<local_id>(s.points.size());
  s.points.push_back({0.5, 0.6, 2});
  s.elements.push_back({v - 2, v - 1, v}); // a lone triangle outside
  check_refused<geometry_error>(s, "3 edges have one triangle only");
  s = cube;
  s.tags = {1, 2};
  check_refused<geometry_error>(s, "2 tags for");
}

TEST_CASE("sizes that cannot be used are named") {
  const triangle_mesh cube = shapes::cube(3);
  CHECK_THROWS_WITH_AS(fill(cube, [](vec3) { return 0.0; }), doctest::Contains("must be positive"),
                       sizing_error);
  CHECK_THROWS_WITH_AS(fill(cube, [](vec3) { return 1e-5; }), doctest::Contains("give larger sizes"),
                       sizing_error);
  fill_options options;
  options.growth = 0;
  check_refused<sizing_error>(cube, "growth", options);
}
