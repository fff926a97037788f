#include "dovetail/mesh/chain_sum.hpp"

#include "dovetail/mesh/simplex.hpp"
#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

template <std::size_t N>
chain_sum sum_of(const std::vector<std::array<local_id, N>>& sides) {
  chain_sum sum;
  for (const auto& side : sides)
    sum.add(side);
  return sum;
}
/// The sides of some elements, one by one.
template <std::size_t N>
std::vector<std::array<local_id, N - 1>> sides_of(const std::vector<std::array<local_id, N>>& elements) {
  std::vector<std::array<local_id, N - 1>> sides;
  for (const auto& element : elements)
    for (const auto& local : numbering::sides<static_cast<int>(N) - 1>) {
      auto& side = sides.emplace_back();
      for (std::size_t k = 0; k + 1 < N; ++k)
        side[k] = element[local[k]];
    }
  return sides;
}

} // namespace

TEST_CASE("an oriented simplex may begin at any of its vertices, and turned over it takes itself away") {
  for (const auto& [a, b, c] : {std::array<local_id, 3>{0, 1, 2}, {7, 3, 5}, {1'000'000, 2, 41}}) {
    CHECK(sum_of<3>({{a, b, c}}) == sum_of<3>({{b, c, a}}));
    CHECK(sum_of<3>({{a, b, c}}) == sum_of<3>({{c, a, b}}));
    CHECK(!(sum_of<3>({{a, b, c}}) == sum_of<3>({{b, a, c}})));
    CHECK(sum_of<3>({{a, b, c}, {b, a, c}}) == chain_sum{});
    CHECK(sum_of<3>({{a, b, c}, {a, c, b}}) == chain_sum{});
    CHECK(!(sum_of<2>({{a, b}}) == sum_of<2>({{b, a}})));
    CHECK(sum_of<2>({{a, b}, {b, a}}) == chain_sum{});
  }
}

TEST_CASE("no two chains of two of all the triangles between a few vertices add up to the same") {
  constexpr local_id vertices = 12;
  std::vector<std::array<local_id, 3>> triangles;
  for (local_id a = 0; a < vertices; ++a)
    for (local_id b = a + 1; b < vertices; ++b)
      for (local_id c = b + 1; c < vertices; ++c) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, b});
      }
  std::size_t same = 0, pairs = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t j = i; j < triangles.size(); ++j)
      for (const std::size_t k : {(i * 7 + j) % triangles.size(), (i + 31 * j) % triangles.size()}) {
        if (k == i || k == j)
          continue;
        ++pairs;
        same += sum_of<3>({triangles[i], triangles[j]}) == sum_of<3>({triangles[k], triangles[j]});
        same += sum_of<3>({triangles[i], triangles[j]}) == sum_of<3>({triangles[k]});
        same += sum_of<3>({triangles[i], triangles[j], triangles[k]}) == chain_sum{};
      }
  CHECK(pairs > 100'000);
  CHECK(same == 0);
}

TEST_CASE("the sides of an element are added at once as they are one by one") {
  std::mt19937 engine(1);
  std::uniform_int_distribution<local_id> vertex(0, 1 << 30);
  for (int turn = 0; turn < 1000; ++turn) {
    const simplex<3> element{vertex(engine), vertex(engine), vertex(engine), vertex(engine)};
    chain_sum at_once;
    at_once.add_sides_of(element);
    CHECK(at_once == sum_of(sides_of<4>({element})));
    const simplex<2> triangle{element[0], element[1], element[2]};
    chain_sum of_triangle;
    of_triangle.add_sides_of(triangle);
    CHECK(of_triangle == sum_of(sides_of<3>({triangle})));
  }
}

TEST_CASE(
    "elements that fit together add up to their boundary, and not when one is lost, doubled or turned") {
  // Around an edge, as slices of an orange: the sides between them cancel.
  std::vector<simplex<3>> slices;
  for (local_id k = 2; k < 9; ++k)
    slices.push_back({0, 1, k, k == 8 ? 2 : k + 1});
  std::vector<simplex<2>> outside;
  for (local_id k = 2; k < 9; ++k) {
    const local_id next = k == 8 ? 2 : k + 1;
    outside.push_back({1, k, next});
    outside.push_back({0, next, k});
  }
  const auto all_sides = [](const std::vector<simplex<3>>& elements) {
    chain_sum sum;
    for (const auto& element : elements)
      sum.add_sides_of(element);
    return sum;
  };
  CHECK(all_sides(slices) == sum_of(outside));
  auto lost = slices, doubled = slices, turned = slices;
  lost.pop_back();
  doubled.push_back(doubled.front());
  std::swap(turned.front()[2], turned.front()[3]);
  for (const auto& wrong : {lost, doubled, turned})
    CHECK(!(all_sides(wrong) == sum_of(outside)));
}
