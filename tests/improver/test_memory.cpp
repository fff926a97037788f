/// @file
/// The native improver needs less than 200 bytes per element, the mesh itself included: all that is allocated
/// is counted.
#include "dovetail/improver/native.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

/// Of the whole program; the tests run in one thread.
std::size_t allocated = 0, most_allocated = 0;
/// In front of each block, to know its size when it is given back.
constexpr std::size_t header = alignof(std::max_align_t);

} // namespace

void* operator new(std::size_t size) {
  auto* block = static_cast<std::byte*>(std::malloc(size + header));
  if (block == nullptr)
    throw std::bad_alloc();
  *reinterpret_cast<std::size_t*>(block) = size;
  allocated += size;
  most_allocated = std::max(most_allocated, allocated);
  return block + header;
}
void operator delete(void* memory) noexcept {
  if (memory == nullptr)
    return;
  auto* block = static_cast<std::byte*>(memory) - header;
  allocated -= *reinterpret_cast<std::size_t*>(block);
  std::free(block);
}
void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}

TEST_CASE("less than 200 bytes per element") {
  using dovetail::improvement::native;
  auto mesh = dovetail_test::shuffled(dovetail_test::jittered_cubes(30, 0.15, 4), 2);
  const auto elements = mesh.elements.size();
  const std::size_t own = elements * sizeof(mesh.elements[0]) + mesh.points.size() * sizeof(mesh.points[0]);
  const std::size_t before = allocated;
  most_allocated = allocated;
  const auto report = native::fine()(mesh, {}, {});
  const std::size_t bytes = (most_allocated - before + own) / elements;
  MESSAGE(bytes << " bytes per element, " << elements << " elements");
  CHECK(report.get("elements before") == static_cast<double>(elements));
  CHECK(bytes > 40); // the counter counts
  CHECK(bytes < 150);
}
