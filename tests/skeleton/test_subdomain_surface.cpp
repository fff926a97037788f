#include "dovetail/meshing/subdomain_surface.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

namespace {

/// A line of three edges between two subsurfaces, as it stands in the skeleton when `first` is the smaller
/// number: along the one with that number.
simplicial_skeleton<2> line_between(local_id first, local_id second, bool backwards) {
  simplicial_skeleton<2> skeleton;
  skeleton.points = {{0, 0, 0}, {3, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  skeleton.sides = {{0, 2}, {2, 3}, {3, 1}};
  if (backwards)
    skeleton.sides = {{1, 3}, {3, 2}, {2, 0}};
  skeleton.subdomains = {{first, second}, {first, second}, {first, second}};
  return skeleton;
}

} // namespace

TEST_CASE("The boundary of a subsurface does not depend on how those beside it are numbered") {
  // Subsurface 1, with its line to a neighbour that was number 2 and is number 0 after a merge.
  const auto before = line_between(1, 2, false);
  const auto after = line_between(0, 1, true);
  const auto one = boundary_of_subdomain(before, sort_by_subdomain(before, 3), 1);
  const auto two = boundary_of_subdomain(after, sort_by_subdomain(after, 3), 1);
  CHECK(one.boundary.elements.size() == 3);
  CHECK(one.boundary.elements == two.boundary.elements);
  CHECK(one.boundary.points == two.boundary.points);
}

TEST_CASE("Points on interfaces are those of sides with another subdomain behind them") {
  auto skeleton = line_between(0, 1, false);
  const auto marks = [&] { // of points 0 to 3
    return boundary_of_subdomain(skeleton, sort_by_subdomain(skeleton, 2), 0).on_interface;
  };
  CHECK(marks() == std::vector<std::uint8_t>{1, 1, 1, 1});
  skeleton.subdomains = {{0, 1}, {0, 1}, {0, no_id}};
  CHECK(marks() == std::vector<std::uint8_t>{1, 0, 1, 1});
  skeleton.subdomains = {{0, 1}, {0, 0}, {0, no_id}};
  CHECK(marks() == std::vector<std::uint8_t>{1, 0, 1, 0});
}
