/// The two trees against searches through everything.
#include "dovetail/core/candidate_octree.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace dovetail;

namespace {

std::vector<vec3> random_points(std::size_t count, std::uint64_t seed) {
  dovetail_test::random_numbers random(seed);
  std::vector<vec3> points(count);
  for (vec3& p : points) // with repeated coordinates
    p = {random.unit(), random.unit(), std::floor(4 * random.unit())};
  return points;
}

constexpr auto itself = [](vec3 p) { return p; };

} // namespace

TEST_CASE("a box tree holds every item once, in boxes that it fits") {
  for (const std::size_t count : {0U, 1U, 4U, 5U, 37U, 1000U}) {
    CAPTURE(count);
    auto points = random_points(count, 7);
    box_tree tree(boxes_of_points(points, itself), 3);
    CHECK(tree.empty() == (count == 0));
    const auto given = points;
    std::vector<local_id> order;
    tree.for_each([](const box3&, std::size_t) { return true; }, [&](local_id k) { order.push_back(k); });
    tree.put_in_order(points);
    REQUIRE(order.size() == count);
    CHECK(std::set<local_id>(order.begin(), order.end()).size() == count);
    for (std::size_t k = 0; k < count; ++k)
      CHECK(points[k] == given[order[k]]);
    const auto boxes = tree.reduce<box3>(
        [&](local_id k) {
          return box3{points[k], points[k]};
        },
        [](const box3& a, const box3& b) { return united(a, b); });
    REQUIRE(boxes.size() == tree.node_count());
    for (std::size_t node = 0; node < boxes.size(); ++node) {
      CHECK(boxes[node].lower == tree.box(node).lower);
      CHECK(boxes[node].upper == tree.box(node).upper);
    }
  }
}

TEST_CASE("the least value over a box tree is that of a search through all") {
  auto points = random_points(500, 3);
  box_tree tree(boxes_of_points(points, itself));
  tree.put_in_order(points);
  std::size_t valued = 0;
  const auto centers = random_points(200, 4);
  for (const vec3& p : centers) {
    const vec3 q = p + vec3{0.3, 0.2, 0.1};
    const auto value = [&](local_id k) { return distance(points[k], q); };
    double expected = 0.5;
    for (std::size_t k = 0; k < points.size(); ++k)
      expected = std::min(expected, value(static_cast<local_id>(k)));
    const double found = tree.least(
        0.5, [&](std::size_t node) { return std::sqrt(distance_squared(tree.box(node), q)); },
        [&](local_id k) {
          ++valued;
          return value(k);
        });
    REQUIRE(found == expected);
  }
  CHECK(valued < 40 * centers.size()); // few of the 500 are looked at
}

TEST_CASE("a box tree tells whether one of its boxes overlaps another") {
  std::vector<box3> boxes;
  for (const vec3& p : random_points(60, 5))
    boxes.push_back({p, p + vec3{0.1, 0.05, 0.1}});
  const box_tree tree(boxes, 2);
  std::size_t overlapping = 0;
  for (const vec3& p : random_points(400, 6)) {
    const box3 other{p, p + vec3{0.02, 0.1, 0.02}};
    const bool expected =
        std::any_of(boxes.begin(), boxes.end(), [&](const box3& box) { return box.overlaps(other); });
    CHECK(tree.any_overlaps(boxes, other) == expected);
    overlapping += expected ? 1 : 0;
  }
  CHECK(overlapping > 20);
  CHECK(overlapping < 380);
  CHECK(!box_tree(std::vector<box3>{}).any_overlaps({}, boxes[0]));
}

TEST_CASE("a search goes to the child that is preferred first") {
  const std::vector<vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const box_tree tree(boxes_of_points(points, itself), 1);
  const auto order = [&](bool rightmost) {
    std::vector<local_id> found;
    tree.search([](std::size_t) { return true; }, [&](local_id k) { found.push_back(k); },
                [&](std::size_t, std::size_t) { return rightmost; });
    return found;
  };
  CHECK(order(false) == std::vector<local_id>{0, 1, 2, 3});
  CHECK(order(true) == std::vector<local_id>{3, 2, 1, 0});
  std::vector<local_id> near;
  tree.for_each_near(
      {2.4, 0, 0}, [](const box3&, std::size_t) { return true; }, [&](local_id k) { near.push_back(k); });
  CHECK(near == std::vector<local_id>{2, 3, 1, 0});
}

TEST_CASE("octants fill a box, bit by bit") {
  const box3 box{{0, 0, 0}, {2, 4, 8}};
  for (unsigned k = 0; k < 8; ++k) {
    const box3 part = octant(box, k);
    CHECK(part.lower == vec3{k & 1U ? 1.0 : 0.0, k & 2U ? 2.0 : 0.0, k & 4U ? 4.0 : 0.0});
    CHECK(part.upper - part.lower == vec3{1, 2, 4});
  }
}

TEST_CASE("an octree finds the leaf around a point, and its children are the octants") {
  octree tree(cube_around({{-1, -1, -1}, {1, 1, 1}}));
  tree.refine([](const box3& box) { return contains(box, {0.3, 0.2, 0.1}) && box.diagonal() > 0.1; });
  CHECK(tree.leaf_count() > 20);
  for (const vec3& p : random_points(300, 5)) {
    const vec3 q = p - vec3{0.5, 0.5, 1.9};
    if (contains(tree.bounds(), q))
      CHECK(contains(tree.box(tree.locate(q)), q));
  }
  for (unsigned k = 0; k < 8; ++k)
    CHECK(distance(tree.box(tree.child(0, k)).center(), octant(tree.bounds(), k).center()) < 1e-12);
}

TEST_CASE("the leaf around a point is the one whose corners are around it, to the last bit") {
  for (const vec3 middle : {vec3{0, 0, 0}, vec3{3e5, -7e4, 1e-3}}) {
    octree tree(cube_around({middle - vec3{1, 0.7, 0.3}, middle + vec3{1, 0.7, 0.3}}));
    for (int level = 0; level < octree::largest_depth; ++level) // to the smallest leaves there are
      tree.split(tree.locate(middle + vec3{0.37, -0.21, 0.11}));
    const auto is_around = [&](const box3& box, vec3 p) {
      bool around = true;
      for (int axis = 0; axis < 3; ++axis) // what is on the cube's upper faces has no leaf beyond it
        around = around && box.lower[axis] <= p[axis] &&
                 (p[axis] < box.upper[axis] || box.upper[axis] == tree.bounds().upper[axis]);
      return around;
    };
    for (std::size_t k = 0; k < tree.leaf_count(); ++k)
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const vec3 at = tree.corner_point(tree.corner_key(tree.leaf(k), corner));
        for (const double towards : {-1e9, 0.0, 1e9}) {
          vec3 p = at;
          for (int axis = 0; axis < 3; ++axis) {
            if (towards != 0)
              p[axis] = std::nextafter(at[axis], towards);
            p[axis] = std::clamp(p[axis], tree.bounds().lower[axis], tree.bounds().upper[axis]);
          }
          CHECK(is_around(tree.box(tree.locate(p)), p));
        }
      }
  }
}

TEST_CASE("candidates are all items that may concern a point, in the order given") {
  const auto centers = random_points(400, 8);
  const double radius = 0.2;
  std::vector<local_id> order;
  box3 bounds;
  for (std::size_t k = 0; k < centers.size(); ++k) {
    order.insert(order.begin(), static_cast<local_id>(k));
    bounds.include(centers[k]);
  }
  const candidate_octree tree(bounds, order, [&](local_id k, const box3& box) {
    return distance_squared(box, centers[k]) <= radius * radius;
  });
  std::size_t listed = 0;
  const auto places = random_points(300, 9);
  for (const vec3& p : places) {
    const auto found = tree.candidates(p);
    CHECK(std::is_sorted(found.rbegin(), found.rend()));
    for (std::size_t k = 0; k < centers.size(); ++k)
      if (contains(bounds, p) && distance(centers[k], p) < radius)
        REQUIRE(std::count(found.begin(), found.end(), static_cast<local_id>(k)) == 1);
    listed += found.size();
  }
  CHECK(listed < 60 * places.size());
  CHECK(tree.candidates({-1, 0, 0}).empty());
  CHECK(candidate_octree().candidates({0, 0, 0}).empty());
}
