#include "dovetail/mesh/mesh_hash.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

using namespace dovetail;

namespace {

/// The hash of one element.
template <std::size_t N>
std::uint64_t hash_of(const std::array<global_id, N>& vertices) {
  io::mesh_hasher hasher;
  hasher.element(vertices);
  return hasher.value();
}

/// Whether the vertices, which are all different, are an odd permutation of their order by size.
template <std::size_t N>
bool is_odd(const std::array<global_id, N>& vertices) {
  int inversions = 0;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = i + 1; j < N; ++j)
      inversions += vertices[i] > vertices[j];
  return inversions % 2 != 0;
}

template <std::size_t N>
void check_all_orders(std::array<global_id, N> vertices) {
  std::sort(vertices.begin(), vertices.end());
  const std::uint64_t even = hash_of(vertices);
  auto exchanged = vertices;
  std::swap(exchanged[0], exchanged[1]);
  const std::uint64_t odd = hash_of(exchanged);
  CHECK(even != odd);
  do
    CHECK(hash_of(vertices) == (is_odd(vertices) ? odd : even));
  while (std::next_permutation(vertices.begin(), vertices.end()));
}

} // namespace

TEST_CASE("the hash of an element depends on its orientation, and on nothing else of its order") {
  check_all_orders<4>({7, 3'000'000'000'000, 0, 12});
  check_all_orders<3>({7, 3'000'000'000'000, 12});
  CHECK(hash_of<4>({1, 2, 3, 4}) != hash_of<4>({1, 2, 3, 5}));
}

TEST_CASE("the hash of a mesh does not depend on the order of its elements, but on its points") {
  simplicial_mesh<3> mesh{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {1, 2, 3, 4}}, {}};
  const auto before = io::mesh_hash(mesh);
  std::swap(mesh.elements[0], mesh.elements[1]);
  CHECK(io::mesh_hash(mesh) == before);
  mesh.points[4].x = 1.5;
  CHECK(io::mesh_hash(mesh) != before);
}
