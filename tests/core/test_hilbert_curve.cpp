#include "dovetail/core/hilbert_curve.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

using namespace dovetail;

namespace {

template <std::size_t Axes>
using cell_of = std::array<std::uint32_t, Axes>;

/// All cells of a grid, each where the curve says it is.
template <std::size_t Axes>
std::vector<cell_of<Axes>> cells_along_curve(int bits) {
  std::vector<cell_of<Axes>> cells(std::size_t{1} << (bits * static_cast<int>(Axes)), {~0U});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cell_of<Axes> cell{};
    for (std::size_t k = 0; k < Axes; ++k)
      cell[k] = static_cast<std::uint32_t>(i >> (k * static_cast<std::size_t>(bits))) & ((1U << bits) - 1);
    const auto place = hilbert_place(cell, bits);
    REQUIRE(place < cells.size());
    REQUIRE(cells[place][0] == ~0U); // no other cell is there
    cells[place] = cell;
  }
  return cells;
}

template <std::size_t Axes>
void check_curve(int bits) {
  const auto cells = cells_along_curve<Axes>(bits);
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    long steps = 0;
    for (std::size_t k = 0; k < Axes; ++k)
      steps += std::labs(static_cast<long>(cells[i][k]) - static_cast<long>(cells[i + 1][k]));
    REQUIRE(steps == 1);
  }
}

} // namespace

TEST_CASE("the curve visits every cell once and steps to a neighbour each time") {
  for (int bits = 1; bits <= 6; ++bits) {
    check_curve<2>(bits);
    check_curve<3>(std::min(bits, 5));
  }
}

TEST_CASE("a finer grid refines the curve: a cell's place begins with that of the cell around it") {
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const cell_of<3> fine{i * 7919 % 1024, i * 104729 % 1024, i * 1299709 % 1024};
    const cell_of<3> around{fine[0] >> 1, fine[1] >> 1, fine[2] >> 1};
    const auto coarse_place = hilbert_place(fine, 10) >> 3;
    CHECK(coarse_place == hilbert_place(around, 9));
  }
}
