#include "dovetail/mesher/native.hpp"
#include "mesher/random_pieces.hpp"
#include "mesher/shapes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

/// Both directions of a triangle: there are elements on both sides.
void add_wall(shapes::surface& s, const simplex<2>& t) {
  s.elements.push_back(t);
  s.elements.push_back({t[0], t[2], t[1]});
}
local_id add_point(shapes::surface& s, vec3 p) {
  s.points.push_back(p);
  return static_cast<local_id>(s.points.size()) - 1;
}
local_id point_at(const shapes::surface& s, vec3 p) {
  for (std::size_t v = 0; v < s.points.size(); ++v)
    if (distance(s.points[v], p) < 1e-9)
      return static_cast<local_id>(v);
  FAIL("no point there");
  return no_id;
}

void check_filled(const shapes::surface& boundary, double size) {
  const auto made = mesher::native{}({boundary, 7}, [size](vec3) { return size; }).mesh;
  CHECK(random_pieces::fault_of(boundary, made) == "");
  CHECK(made.tags == std::vector<local_id>(made.elements.size(), 7));
}
/// With and without points inside, and turned, so that no plane is one of the axes.
void check_filled(shapes::surface boundary) {
  for (int turned = 0; turned < 2; ++turned) {
    for (const double size : {0.2, 100.0}) {
      CAPTURE(turned);
      CAPTURE(size);
      check_filled(boundary, size);
    }
    random_pieces::dice d(3);
    random_pieces::turn_about_axes(boundary, d);
  }
}

/// A bent sheet of squares from u to u + 1 within the cube of two squares an edge; `at` places its points.
template <class F>
void add_sheet(shapes::surface& s, int n, const F& at) {
  std::vector<std::vector<local_id>> grid;
  for (int i = 0; i <= n; ++i) {
    grid.emplace_back();
    for (int j = 0; j <= n; ++j)
      grid.back().push_back(add_point(s, at(double(i) / n, double(j) / n)));
  }
  for (std::size_t i = 0; i + 1 < grid.size(); ++i)
    for (std::size_t j = 0; j + 1 < grid.size(); ++j) {
      add_wall(s, {grid[i][j], grid[i + 1][j], grid[i + 1][j + 1]});
      add_wall(s, {grid[i][j], grid[i + 1][j + 1], grid[i][j + 1]});
    }
}

} // namespace

TEST_CASE("a wall may end anywhere inside: it touches nothing, a point, an edge or the edges of a side") {
  auto alone = shapes::cube(2);
  add_wall(alone, {add_point(alone, {0.3, 0.3, 0.4}), add_point(alone, {0.7, 0.3, 0.5}),
                   add_point(alone, {0.5, 0.7, 0.6})});
  check_filled(alone);

  auto at_point = shapes::cube(2);
  add_wall(at_point, {point_at(at_point, {0.5, 0.5, 1}), add_point(at_point, {0.3, 0.4, 0.5}),
                      add_point(at_point, {0.7, 0.6, 0.4})});
  check_filled(at_point);

  auto at_edge = shapes::cube(2);
  const local_id a = point_at(at_edge, {0.5, 0.5, 1}), b = point_at(at_edge, {0.5, 0, 1});
  add_wall(at_edge, {a, b, add_point(at_edge, {0.5, 0.3, 0.4})});
  check_filled(at_edge);

  auto across = shapes::cube(2); // from side to side, with two edges that end inside
  add_wall(across, {point_at(across, {0.5, 0.5, 1}), point_at(across, {0.5, 0.5, 0}),
                    point_at(across, {1, 0.5, 0.5})});
  check_filled(across);
}

TEST_CASE("sheets that end inside: flat, bent, thin gaps between them, and many at one edge") {
  auto bent = shapes::cube(4);
  add_sheet(bent, 4, [](double u, double v) {
    return vec3{0.2 + 0.6 * u, 0.2 + 0.6 * v, 0.5 + 0.2 * std::sin(5 * u) * std::cos(4 * v)};
  });
  check_filled(bent);

  auto narrow = shapes::cube(4);
  for (const double z : {0.5, 0.501, 0.503})
    add_sheet(narrow, 3, [z](double u, double v) { return vec3{0.2 + 0.6 * u, 0.2 + 0.5 * v + 0.1 * u, z}; });
  check_filled(narrow);

  for (const int count : {3, 4, 9}) { // an edge with many walls, free at both of its ends or at one
    CAPTURE(count);
    for (const bool is_free : {true, false}) {
      auto star = shapes::cube(2);
      const local_id top = is_free ? add_point(star, {0.5, 0.5, 0.8}) : point_at(star, {0.5, 0.5, 1});
      const local_id bottom = add_point(star, {0.5, 0.5, 0.2});
      for (int k = 0; k < count; ++k) {
        const double angle = random_pieces::unbiased_angle(k, count);
        add_wall(star, {top, bottom,
                        add_point(star, {0.5 + 0.3 * std::cos(angle), 0.5 + 0.3 * std::sin(angle), 0.5})});
      }
      check_filled(star);
    }
  }
}

TEST_CASE("a void that hangs on a wall, and walls from one void to another") {
  auto s = shapes::cube(2);
  shapes::append(s, shapes::cube(1, 0.2, {0.2, 0.4, 0.4}), true);
  shapes::append(s, shapes::cube(1, 0.2, {0.6, 0.4, 0.4}), true);
  const local_id a = point_at(s, {0.4, 0.4, 0.4}), b = point_at(s, {0.4, 0.4, 0.6}),
                 c = point_at(s, {0.6, 0.4, 0.6}), e = point_at(s, {0.6, 0.4, 0.4});
  add_wall(s, {a, b, c});
  add_wall(s, {a, c, e});
  add_wall(s, {b, c, point_at(s, {0.5, 0.5, 1})});
  check_filled(s);
}

TEST_CASE("walls that cannot be there are named with their places") {
  const auto refused = [](const shapes::surface& s, const char* text) {
    CHECK_THROWS_WITH_AS(mesher::native{}({s, 0}, [](vec3) { return 100.0; }), doctest::Contains(text),
                         mesher_error);
  };
  auto once = shapes::cube(2); // in one direction: open
  const local_id p = add_point(once, {0.3, 0.3, 0.4}), q = add_point(once, {0.7, 0.3, 0.5});
  once.elements.push_back({p, q, add_point(once, {0.5, 0.7, 0.6})});
  refused(once, ("edge (" + std::to_string(p)).c_str());

  auto crossing = shapes::cube(2);
  add_wall(crossing, {add_point(crossing, {0.2, 0.2, 0.5}), add_point(crossing, {0.8, 0.2, 0.5}),
                      add_point(crossing, {0.5, 0.8, 0.5})});
  add_wall(crossing, {add_point(crossing, {0.5, 0.3, 0.2}), add_point(crossing, {0.5, 0.3, 0.8}),
                      add_point(crossing, {0.5, 0.6, 0.5})});
  refused(crossing, "which passes through");

  auto sticking_out = shapes::cube(2);
  add_wall(sticking_out, {add_point(sticking_out, {0.3, 0.3, 0.5}), add_point(sticking_out, {0.4, 0.6, 0.5}),
                          add_point(sticking_out, {1.7, 0.4, 0.6})});
  refused(sticking_out, "which passes through");

  auto outside = shapes::cube(2); // elements on both sides, but in no shell
  add_wall(outside, {add_point(outside, {2.3, 0.3, 0.5}), add_point(outside, {2.4, 0.6, 0.5}),
                     add_point(outside, {2.7, 0.4, 0.6})});
  refused(outside, "is inside and outside of the boundary at once");
  refused(outside, "the element at (");

  auto twice = shapes::cube(2); // a shell within another that is no void
  shapes::append(twice, shapes::cube(2, 0.4, {0.3, 0.3, 0.3}));
  refused(twice, "is inside and outside of the boundary at once");
}
