#include "dovetail/intersection/suppression.hpp"
#include "dovetail/parallel/serial.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

namespace {

/// Two interface triangles through each other, a third one through the second, far from the first.
fine_skeleton three_triangles() {
  fine_skeleton skeleton;
  skeleton.points = {{0, 0, 0}, {1, 0, 0},  {0, 1, 0}, {0.2, 0.2, -1}, {0.2, 0.2, 1},
                     {9, 9, 0}, {8, 8, -1}, {9, 8, 1}, {8, 9, 1}};
  skeleton.sides = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  skeleton.subdomains = {{0, 1}, {2, 3}, {4, 5}};
  skeleton.side_hosts = {no_id, no_id, no_id};
  return skeleton;
}

std::size_t crossings(const known_apart& known) {
  const fine_skeleton skeleton = three_triangles();
  return plan_suppression(skeleton, {false, false, false}, parallel::serial{}, known).crossings;
}

box3 box_around(const fine_skeleton& skeleton, std::size_t triangle) {
  box3 box;
  for (const local_id v : skeleton.sides[triangle])
    box.include(skeleton.points[v]);
  return box;
}

} // namespace

TEST_CASE("Only pairs that are not known to be apart are searched, and all of these") {
  const fine_skeleton skeleton = three_triangles();
  CHECK(crossings({}) == 2);
  CHECK(crossings({{false, false, false},
                   {box_around(skeleton, 0), box_around(skeleton, 1), box_around(skeleton, 2)}}) == 2);
  CHECK(crossings({{true, true, true}, {}}) == 0);
  CHECK(crossings({{true, true, false}, {box_around(skeleton, 2)}}) == 1);
  CHECK(crossings({{true, true, false},
                   {box_around(skeleton, 0), box_around(skeleton, 1), box_around(skeleton, 2)}}) == 1);
  CHECK(crossings({{false, true, true}, {box_around(skeleton, 0)}}) == 1);
  CHECK(crossings({{true, false, true}, {box_around(skeleton, 1)}}) == 2);
}

TEST_CASE("What is found near the rest is named by its own number") {
  const fine_skeleton skeleton = three_triangles();
  const auto plan = plan_suppression(skeleton, {false, false, false}, parallel::serial{},
                                     {{true, true, false}, {box_around(skeleton, 2)}});
  CHECK(plan.merges == std::vector<std::array<local_id, 2>>{{2, 3}});
}

TEST_CASE("Of new patches nothing is known, and their boxes are searched") {
  const fine_skeleton skeleton = three_triangles();
  const std::vector<local_id> first{0, 1, 2, 3}; // each a patch
  const auto patch = [](std::uint64_t name) { return kept<patch_mesh>(content_key{name}); };
  const std::vector<kept<patch_mesh>> patches{patch(7), patch(3), patch(5)};
  const auto known_of = [&](const std::vector<std::uint64_t>& names) {
    std::vector<kept<patch_mesh>> apart;
    for (const std::uint64_t name : names)
      apart.push_back(patch(name));
    return known_from_patches(skeleton, first, patches, apart);
  };
  CHECK(known_of({}).triangles.empty());
  CHECK(known_of({3, 5, 7}).triangles == std::vector<bool>{true, true, true});
  const known_apart known = known_of({3, 7, 9});
  CHECK(known.triangles == std::vector<bool>{true, true, false});
  REQUIRE(known.around_others.size() == 1);
  CHECK(known.around_others[0].lower == box_around(skeleton, 2).lower);
  CHECK(known.around_others[0].upper == box_around(skeleton, 2).upper);
  CHECK(crossings(known) == 1);
}
