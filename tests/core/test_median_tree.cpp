#include "dovetail/core/median_tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <tuple>
#include <vector>

using namespace dovetail;

namespace {

struct counting_node : median_node {
  int items = 0;
  void include(const vec3&) { ++items; }
};

} // namespace

TEST_CASE("a median tree's nodes hold their items, halved down to the leaves") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const std::size_t count : {0U, 1U, 4U, 5U, 37U, 1000U}) {
    std::vector<vec3> items(count);
    for (vec3& p : items)
      p = {uniform(random), uniform(random), std::floor(4 * uniform(random))}; // with repeated coordinates
    auto sorted = items;
    const auto by_place = [](const vec3& a, const vec3& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    const auto nodes = build_median_tree<counting_node>(items, 4, [](const vec3& p) { return p; });
    CHECK(nodes.empty() == (count == 0));
    for (std::size_t id = 0; id < nodes.size(); ++id) {
      const auto& n = nodes[id];
      REQUIRE(n.items == static_cast<int>(n.last - n.first));
      box3 box;
      for (std::size_t i = n.first; i < n.last; ++i)
        box.include(items[i]);
      REQUIRE(box.lower == n.box.lower);
      REQUIRE(box.upper == n.box.upper);
      REQUIRE(n.is_leaf() == (n.last - n.first <= 4));
      if (n.is_leaf())
        continue;
      const auto &left = nodes[id + 1], &right = nodes[n.right];
      REQUIRE(left.first == n.first);
      REQUIRE(left.last == right.first);
      REQUIRE(right.last == n.last);
      REQUIRE(left.last - left.first == (n.last - n.first) / 2);
    }
    std::sort(sorted.begin(), sorted.end(), by_place);
    std::sort(items.begin(), items.end(), by_place);
    CHECK(sorted == items);
  }
}
