#include "dovetail/core/report.hpp"

#include "dovetail/core/error.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

using namespace dovetail;

namespace {

struct sheep_counts {
  std::int64_t white = 0;
  bool is_counted_twice = false;
  double mean_weight = 0;
  std::optional<int> lost = {};

  using fields = field_list<&sheep_counts::white, &sheep_counts::is_counted_twice, &sheep_counts::mean_weight,
                            &sheep_counts::lost>;
};

template <class T>
struct of_template {
  T first = 0;

  using fields = field_list<&of_template::first>;
};

std::vector<std::string> names_in(const report& made) {
  std::vector<std::string> names;
  for (const auto& counter : made.counters)
    names.push_back(counter.first);
  return names;
}

} // namespace

TEST_CASE("Fields become counters of their names, and come back") {
  report made;
  made.set(sheep_counts{.white = 12, .is_counted_twice = true, .mean_weight = 45.5});
  CHECK(names_in(made) == std::vector<std::string>{"white", "is_counted_twice", "mean_weight"});
  CHECK(made.get("white") == 12);
  CHECK(made.get("is_counted_twice") == 1);
  CHECK(made.get("mean_weight") == 45.5);

  made.set(sheep_counts{.white = 11, .lost = 1});
  CHECK(names_in(made) == std::vector<std::string>{"white", "is_counted_twice", "mean_weight", "lost"});
  const auto read = made.as<sheep_counts>();
  CHECK(read.white == 11);
  CHECK_FALSE(read.is_counted_twice);
  CHECK(read.mean_weight == 0);
  CHECK(read.lost == 1);

  report other;
  other.set(of_template<int>{3});
  CHECK(other.get("first") == 3);
  CHECK(other.as<sheep_counts>().white == 0); // what was never set
  CHECK_FALSE(other.as<sheep_counts>().lost);
}

TEST_CASE("A counter that nobody has set is no zero") {
  report made;
  made.name = "farm";
  CHECK_THROWS_WITH_AS(made.get("white"), "the report 'farm' has no counter 'white'; it has none",
                       usage_error);
  made.set("white", 3);
  made.add("black", 2);
  made.add("black", 2);
  CHECK(made.get("black") == 4);
  CHECK_THROWS_WITH_AS(made.get("wihte"), "the report 'farm' has no counter 'wihte'; it has white, black",
                       usage_error);
  CHECK(made.get("wihte", -1) == -1);
}
