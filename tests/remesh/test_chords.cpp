#include "dovetail/remesh/chords.hpp"

#include <doctest/doctest.h>

#include <map>

using namespace dovetail;

TEST_CASE("chords are the inner sides between boundary points, by their labels") {
  // A strip of three squares along x, points 0 to 3 below, 4 to 7 above, 8 inside the first square.
  patch_boundary boundary;
  boundary.labels = {30, 31, 32, 33, 34, 35, 36, 37};
  boundary.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 7}, {7, 6}, {6, 5}, {5, 4}, {4, 0}};
  const std::vector<simplex<2>> triangles{{0, 1, 8}, {1, 5, 8}, {5, 4, 8}, {4, 0, 8},
                                          {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}};
  std::map<std::array<local_id, 2>, std::vector<std::size_t>> found;
  chord_finder(boundary).for_each(
      triangles, [&](std::size_t t, const std::array<local_id, 2>& chord) { found[chord].push_back(t); });
  CHECK(found == std::map<std::array<local_id, 2>, std::vector<std::size_t>>{
                     {{31, 35}, {1, 5}}, {{31, 36}, {4, 5}}, {{32, 36}, {4, 7}}, {{32, 37}, {6, 7}}});

  SUBCASE("a side whose ends have the labels of a segment, or one label, is none") {
    boundary.labels[5] = 32; // side 1-5 is called as segment 1-2 is
    boundary.labels[6] = 31; // and side 1-6 joins a point with itself
    const chord_finder chord_of(boundary);
    CHECK(!chord_of(1, 5));
    CHECK(!chord_of(1, 6));
    CHECK(chord_of(7, 2) == std::array<local_id, 2>{32, 37});
  }
  SUBCASE("without labels points are their own") {
    const chord_finder chord_of(8, boundary.segments);
    CHECK(chord_of(5, 1) == std::array<local_id, 2>{1, 5});
    CHECK(!chord_of(2, 1));
    CHECK(!chord_of(1, 8));
  }
}
