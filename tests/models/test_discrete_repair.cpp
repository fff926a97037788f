#include "discrete_shapes.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>
#include <random>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

double volume_of(const oriented_surfaces& s, local_id solid) {
  double sum = 0;
  for (std::size_t t = 0; t < s.mesh.elements.size(); ++t) {
    const auto& v = s.mesh.elements[t];
    if (s.solid_of[t] == solid)
      sum += signed_volume({}, s.mesh.points[v[0]], s.mesh.points[v[1]], s.mesh.points[v[2]]);
  }
  return sum;
}

std::string refusal(const triangle_soup& soup) {
  return refusal_of<geometry_error>([&] { return repaired(soup, "part.stl"); });
}

/// Every triangle with corners of its own, as STL has them.
triangle_soup exploded(const triangle_soup& soup) {
  triangle_soup out;
  for (const auto& t : soup.triangles) {
    const auto first = static_cast<local_id>(out.points.size());
    for (const auto v : t)
      out.points.push_back(soup.points[v]);
    out.triangles.push_back({first, first + 1, first + 2});
    out.groups.push_back(no_id);
  }
  return out;
}

} // namespace

TEST_CASE("no triangles at all, and nothing but degenerate ones, are refused for what they are") {
  CHECK(refusal({}).find("part.stl: there are no triangles") == 0);
  triangle_soup flat{.points = {{0, 0, 0}, {1, 0, 0}}, .triangles = {{0, 1, 1}}};
  CHECK(refusal(flat).find("part.stl: all triangles are degenerate") == 0);
}

TEST_CASE("points are merged, triangles turned consistently outwards") {
  auto soup = exploded(box_soup({0, 0, 0}, {1, 2, 3}, 3));
  std::mt19937 random(1);
  for (auto& t : soup.triangles)
    if (random() % 2 == 0)
      std::swap(t[0], t[2]);
  const auto s = repaired(soup);
  CHECK(s.mesh.points.size() == 56);
  CHECK(s.mesh.elements.size() == 108);
  CHECK(s.solids == 1);
  CHECK(volume_of(s, 0) == doctest::Approx(6));
  CHECK(s.repairs.get("turned") > 10);
}

TEST_CASE("points that differ by rounding are merged when the surface is open otherwise") {
  auto soup = exploded(box_soup({0, 0, 0}, {1, 1, 1}, 2));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1e-7, 1e-7);
  for (vec3& p : soup.points)
    p += vec3{noise(random), noise(random), noise(random)};
  const auto s = repaired(soup);
  CHECK(s.mesh.points.size() == 26);
  CHECK(volume_of(s, 0) == doctest::Approx(1));
}

TEST_CASE("degenerate and repeated triangles go, and caps are flipped") {
  auto soup = box_soup({0, 0, 0}, {1, 1, 1});
  soup.triangles.push_back(soup.triangles[3]);
  soup.triangles.push_back({0, 0, 1});
  soup.groups.assign(soup.triangles.size(), no_id);
  const auto s = repaired(soup);
  CHECK(s.mesh.elements.size() == 12);
  CHECK(s.repairs.get("duplicates") == 1);
  CHECK(s.repairs.get("degenerate") == 1);

  // A tetrahedron with a point in the middle of an edge; on one side it makes a cap without area.
  triangle_soup tetrahedron;
  tetrahedron.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  tetrahedron.groups.assign(6, no_id);
  const auto flipped = repaired(tetrahedron);
  CHECK(flipped.repairs.get("flipped_caps") == 1);
  CHECK(volume_of(flipped, 0) == doctest::Approx(8.0 / 6));
  for (const auto& t : flipped.mesh.elements) {
    const auto at = [&](std::size_t i) { return flipped.mesh.points[t[i]]; };
    CHECK(norm(cross(at(1) - at(0), at(2) - at(0))) > 0.1);
  }
}

TEST_CASE("nested shells are voids and solids in turn, separate ones are solids") {
  triangle_soup soup;
  append(soup, box_soup({0, 0, 0}, {10, 10, 10}), true);
  append(soup, box_soup({2, 2, 2}, {8, 8, 8}, 2));
  append(soup, box_soup({4, 4, 4}, {6, 6, 6}));
  append(soup, box_soup({20, 0, 0}, {21, 1, 1}));
  const auto s = repaired(soup);
  REQUIRE(s.solids == 3);
  CHECK(s.repairs.get("voids") == 1);
  CHECK(volume_of(s, 0) == doctest::Approx(1000 - 216));
  CHECK(volume_of(s, 1) == doctest::Approx(8));
  CHECK(volume_of(s, 2) == doctest::Approx(1));
}

TEST_CASE("open, crowded, one-sided and crossing surfaces are refused with a place") {
  auto open = box_soup({0, 0, 0}, {1, 1, 1}, 4);
  open.triangles.erase(open.triangles.begin() + 5);
  open.groups.resize(open.triangles.size());
  CHECK(has(refusal(open), "part.stl: the surface is open: 3 edges"));

  triangle_soup crowded;
  append(crowded, box_soup({0, 0, 0}, {1, 1, 1}));
  append(crowded, box_soup({1, 1, 0}, {2, 2, 1}));
  CHECK(has(refusal(crowded), "not manifold"));

  triangle_soup crossing;
  append(crossing, box_soup({0, 0, 0}, {2, 2, 2}));
  append(crossing, box_soup({1, 1, 1}, {3, 3, 3.5}));
  CHECK(has(refusal(crossing), "crosses itself"));

  // The projective plane on six points: closed, with one side.
  triangle_soup projective;
  projective.points = {{0, 0, 1}, {1, 0, 0}, {0.3, 1, 0}, {-0.8, 0.6, 0.1}, {-0.8, -0.6, 0}, {0.3, -1, 0.2}};
  projective.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                          {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  projective.groups.assign(10, no_id);
  CHECK(has(refusal(projective), "one side only"));

  triangle_soup flat;
  flat.points = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  flat.triangles = {{0, 1, 2}};
  flat.groups = {no_id};
  CHECK(has(refusal(flat), "degenerate"));
}

TEST_CASE("places in messages are short, however large the coordinates are") {
  auto soup = box_soup({0, 0, 0}, {1e150, 1e150, 1e150});
  soup.triangles.pop_back();
  soup.groups.pop_back();
  const std::string said = refusal(soup);
  CHECK(said.find("e+1") != std::string::npos);
  CHECK(said.size() < 250);
}

TEST_CASE("triangles of a file that are listed twice or the wrong way round are counted and told") {
  const auto cube = box_soup({0, 0, 0}, {1, 1, 1}, 2);
  CHECK(repaired_file(cube, "part.stl").repairs.warnings.empty());

  auto turned = cube;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]); // the first one, which others are turned by
  std::swap(turned.triangles[7][1], turned.triangles[7][2]);
  turned.triangles.push_back(turned.triangles[3]);
  turned.groups.push_back(no_id);
  const auto s = repaired_file(turned, "part.stl");
  CHECK(s.repairs.get("turned") == 2);
  CHECK(s.repairs.get("duplicates") == 1);
  REQUIRE(s.repairs.warnings.size() == 2);
  CHECK(s.repairs.warnings[0] == "part.stl: 1 triangle is a copy of another one and was left out");
  CHECK(s.repairs.warnings[1] == "part.stl: 2 triangles were listed the wrong way round and turned");
  CHECK(volume_of(s, 0) == doctest::Approx(1));

  triangle_soup inwards;
  append(inwards, cube, true);
  CHECK(repaired(inwards).repairs.get("turned") == 48);
}
