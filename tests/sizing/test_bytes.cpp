// Sizes that are sent to another process as bytes are the same there.
#include "dovetail/parallel/kept.hpp"
#include "dovetail/sizing/background.hpp"
#include "dovetail/sizing/graded.hpp"
#include "dovetail/sizing/point_sizes.hpp"
#include "dovetail/sizing/refined_sizing.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace dovetail;
using dovetail_test::jittered_cubes;
using dovetail_test::random_numbers;

namespace {

constexpr int samples = 20000;

/// In the unit cube and beyond.
class random_places {
public:
  vec3 point() { return {coordinate(), coordinate(), coordinate()}; }
  box3 box() {
    box3 result;
    const vec3 corner = point();
    result.include(corner);
    result.include(corner + 0.1 * point());
    return result;
  }

private:
  double coordinate() { return 0.5 + numbers_.signed_unit(); }
  random_numbers numbers_{7};
};

template <class Field>
byte_buffer bytes_of(const Field& field) {
  byte_writer to;
  field.encode(to);
  return to.take();
}

/// Values and bounds bit for bit, and again the same bytes; whatever is cut off is missed.
template <class Field, class Decode>
void check_sent(const Field& field, const Decode& decode) {
  const byte_buffer bytes = bytes_of(field);
  byte_reader from(bytes);
  const Field there = decode(from);
  CHECK(from.at_end());
  CHECK(bytes_of(there) == bytes);
  random_places places;
  int different = 0;
  for (int k = 0; k < samples; ++k) {
    const vec3 p = places.point();
    different += field(p) != there(p);
    const box3 box = places.box();
    different += field.smallest_size_in(box) != there.smallest_size_in(box);
  }
  CHECK(different == 0);
  for (const std::size_t length : {bytes.size() - 1, bytes.size() / 2, std::size_t{5}}) {
    const byte_buffer cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    byte_reader early(cut);
    CHECK_THROWS_AS(decode(early), input_error);
  }
}

const auto uneven = [](vec3 p) {
  return 0.02 + 0.3 * std::abs(p.x - 0.3) + 0.1 * std::sin(7 * p.y) * std::sin(7 * p.y);
};

} // namespace

TEST_CASE("A field of limited growth is sent as its octree") {
  const graded_size field(uneven, {{0, 0, 0}, {1, 1, 1}}, {.slope = 0.2});
  check_sent(field, [](byte_reader& from) { return graded_size::decode(from); });
  const byte_buffer bytes = bytes_of(field);
  CHECK(bytes.size() < 40 * field.leaf_count());
  byte_reader from(bytes);
  const auto there = graded_size::decode(from);
  CHECK(there.leaf_count() == field.leaf_count());
  CHECK(there.error_bound() == field.error_bound());
  CHECK(there.slope() == field.slope());
}

TEST_CASE("An octree made of its splits has the same nodes and leaves; splits of none are refused") {
  octree tree(cube_around({{0, 0, 0}, {1, 2, 3}}));
  tree.refine([](const box3& box) {
    return distance_squared(box, {0.3, 0.4, 0.5}) < 0.01 && box.diagonal() > 0.1;
  });
  tree.split(tree.leaf(0));
  const octree again(tree.bounds(), tree.splits());
  REQUIRE(again.node_count() == tree.node_count());
  REQUIRE(again.leaf_count() == tree.leaf_count());
  for (std::size_t k = 0; k < tree.leaf_count(); ++k) {
    CHECK(again.leaf(k) == tree.leaf(k));
    CHECK(again.corner_key(again.leaf(k), 7) == tree.corner_key(tree.leaf(k), 7));
  }
  for (std::size_t node = 1; node < tree.node_count(); ++node)
    CHECK(tree.child(again.parent(node), (node - 1) % 8) == node);
  const box3 cube = tree.bounds();
  CHECK_THROWS_AS(octree(cube, {1}), input_error);
  CHECK_THROWS_AS(octree(cube, {0, 0}), input_error);
  CHECK(octree(cube, {}).leaf_count() == 1);
}

TEST_CASE("A field of values on a mesh is sent with the mesh") {
  simplicial_mesh<3> mesh = jittered_cubes(5);
  std::vector<double> sizes;
  for (const vec3 p : mesh.points)
    sizes.push_back(uneven(p));
  check_sent(background_field(std::move(mesh), std::move(sizes)),
             [](byte_reader& from) { return background_field::decode(from); });
}

TEST_CASE("A field of sizes at points is sent as these") {
  std::vector<sized_point> points;
  random_places places;
  for (int k = 0; k < 500; ++k) {
    const vec3 p = places.point();
    points.push_back({p, uneven(p)});
  }
  check_sent(point_sizes(std::move(points), 0.3, 0.5),
             [](byte_reader& from) { return point_sizes::decode(from); });
}

TEST_CASE("a field that is refined keeps the bounds of the plain one") {
  const box3 box{{0, 0, 0}, {1, 1, 1}};
  CHECK(smallest_size_in(refined_sizing(uniform_size(2)).near(box), box) == 2);
  CHECK(smallest_size_in(refined_sizing([](vec3) { return 2.0; }).near(box), box) == 0); // which knows none
}

TEST_CASE(
    "What rounds of refinement added is sent, for the field it was added to, with the same balls at places") {
  refined_sizing field(uneven);
  random_places places;
  for (int round = 0; round < 3; ++round) {
    std::vector<size_ball> balls;
    for (int k = 0; k < 10; ++k)
      balls.push_back({places.point(), 0.05, 0.01 + 0.02 * k});
    field.refine(balls);
  }
  byte_writer to;
  field.encode(to);
  const byte_buffer bytes = to.take();
  byte_reader from(bytes);
  const auto there = refined_sizing::decode(uneven, from);
  const any_sizing everywhere = field.everywhere(), everywhere_there = there.everywhere();
  int different = 0, refined = 0;
  for (int k = 0; k < samples; ++k) {
    const box3 box = places.box();
    different += kept<int>::of(field.balls_near(box)) != kept<int>::of(there.balls_near(box));
    refined += !field.balls_near(box).empty();
    const vec3 p = places.point();
    different += everywhere(p) != everywhere_there(p);
    if (k % 100 == 0)
      different += field.near(box)(p) != there.near(box)(p);
  }
  CHECK(different == 0);
  CHECK(refined > 0);
}
