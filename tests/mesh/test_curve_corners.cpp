/// Which vertices are where two curves of a face run into each other.
#include "dovetail/mesh/curve_corners.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <vector>

using namespace dovetail;

namespace {

/// Two curves, 3 below and 4 above, that leave vertex 0 at an angle, up to vertices 3 and 6; the first column
/// of points is at x = 1. What is added comes on no curve.
struct corner_of_face {
  std::vector<vec3> points;
  std::vector<host> hosts{{0, 0}, {1, 3}, {1, 3}, {0, 3}, {1, 4}, {1, 4}, {0, 6}};
  std::vector<detail::face_triangle> triangles;

  explicit corner_of_face(std::array<double, 3> heights)
      : points{{0, 0, 0},          {1, 0, 0},          {2, 0, 0},         {3, 0, 0},
               {1, heights[0], 0}, {2, heights[1], 0}, {3, heights[2], 0}} {
    for (const simplex<3>& t :
         {simplex<3>{0, 1, 4, 0}, {1, 2, 4, 0}, {2, 5, 4, 0}, {2, 3, 5, 0}, {3, 6, 5, 0}})
      add(t[0], t[1], t[2]);
  }

  local_id add_point(vec3 p) {
    points.push_back(p);
    return static_cast<local_id>(points.size()) - 1;
  }
  void add(local_id a, local_id b, local_id c, local_id face = 0) { triangles.push_back({{a, b, c}, face}); }

  bool hold(std::initializer_list<local_id> vertices, double share = 1) const {
    return detail::curve_corners(points, hosts, triangles, 30).hold(std::vector<local_id>(vertices), share);
  }
};

const corner_of_face sharp({0.1, 0.2, 0.3});

} // namespace

TEST_CASE("vertices on both of two curves that meet in a small angle are in the corner") {
  CHECK(sharp.hold({1, 2, 4}));
  CHECK(sharp.hold({2, 3, 5}));
  CHECK(sharp.hold({3, 6, 5})); // the curves' other ends
  CHECK(!sharp.hold({0, 1, 2}));
  CHECK(!sharp.hold({0, 3}));
  CHECK(!corner_of_face({1, 0.2, 0.2}).hold({2, 3, 5})); // of 45 degrees, narrow further on
}

TEST_CASE("they are as near as is asked for") {
  CHECK(sharp.hold({2, 5, 1}, 0.4)); // 0.2 apart, and 1.02 the others
  CHECK(!sharp.hold({2, 5, 1}, 0.19));
}

TEST_CASE("a vertex inside is between the curves of those that it is joined to, unless the face is wide") {
  corner_of_face given = sharp;
  const local_id inner = given.add_point({2.5, 0.1, 0});
  std::erase_if(given.triangles,
                [](const auto& t) { return std::count(t.vertices.begin(), t.vertices.end(), 3); });
  for (const auto& [a, b] : {std::array<local_id, 2>{2, 3}, {3, 6}, {6, 5}, {5, 2}})
    given.add(a, b, inner);
  CHECK(given.hold({inner}));
  CHECK(given.hold({2, 3, inner}));
  CHECK(!given.hold({3}));
  for (const double x : {1.0, 2.0, 3.0})
    given.add(2, given.add_point({x, -1, 0}), inner);
  CHECK(!given.hold({inner}));
}

TEST_CASE(
    "other parts of the face at the vertex do not make the corner wide, parts of the corner do not hide it") {
  corner_of_face twice = sharp;
  twice.add(0, twice.add_point({-1, 1, 0}), twice.add_point({-1, -1, 0}));
  CHECK(twice.hold({1, 2, 4}));
  corner_of_face other_face = sharp;
  other_face.add(0, 1, other_face.add_point({0, 0, 1}), 1);
  CHECK(other_face.hold({1, 2, 4}));

  // Three vertices on curves at the corner; that in the middle is on one that goes past.
  corner_of_face divided = sharp;
  const auto middle = static_cast<local_id>(divided.hosts.size());
  divided.hosts.push_back({1, 5});
  divided.add_point({1, 0.05, 0});
  divided.triangles.erase(divided.triangles.begin());
  divided.add(0, 1, middle);
  divided.add(0, 1, divided.add_point({0, 0, 1}), 1);
  divided.add(0, middle, 4);
  CHECK(divided.hold({1, 2, 4}));

  corner_of_face wide({0.4, 0.8, 1.2}); // 22 degrees, and as much on the other side of the lower curve
  CHECK(wide.hold({1, 2, 4}));
  corner_of_face twice_wide = wide;
  const auto below = static_cast<local_id>(twice_wide.hosts.size());
  twice_wide.hosts.push_back({1, 5});
  twice_wide.add_point({1, -0.4, 0});
  twice_wide.add(0, below, 1);
  CHECK(!twice_wide.hold({1, 2, 4}));
  CHECK(!twice_wide.hold({below, 4}));
}

TEST_CASE("curves that meet at both ends are apart at the wide one") {
  corner_of_face lens({0.1, 2, 0});
  lens.triangles.pop_back(); // both curves end at vertex 3
  CHECK(lens.hold({1, 2, 4}));
  CHECK(lens.hold({3, 5}));
  CHECK(!lens.hold({3}));
  CHECK(!lens.hold({0}));
}
