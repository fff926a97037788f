#include "dovetail/core/compressed_rows.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace dovetail;

TEST_CASE("items go into their rows in the order in which they were given") {
  const std::vector<int> row_of{2, 0, 2, 3, 0, 2};
  const auto sorted = sorted_into_rows<char>(5, [&](const auto& put) {
    for (std::size_t k = 0; k < row_of.size(); ++k)
      put(row_of[k], static_cast<char>('a' + k));
  });
  REQUIRE(sorted.size() == 5);
  const auto row = [&](int r) { return std::string(sorted[r].begin(), sorted[r].end()); };
  CHECK(row(0) == "be");
  CHECK(row(1).empty());
  CHECK(row(2) == "acf");
  CHECK(row(3) == "d");
  CHECK(row(4).empty());
}

TEST_CASE("no rows hold nothing") {
  CHECK(compressed_rows<int>{}.size() == 0);
  CHECK(sorted_into_rows<int>(0, [](const auto&) {}).size() == 0);
}
