#include "dovetail/core/encoding.hpp"
#include "dovetail/core/fields.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <map>
#include <random>

using namespace dovetail;

namespace {

struct place {
  double x = 0, y = 0;
  friend bool operator==(const place&, const place&) = default;
};

struct tree {
  std::string name;
  std::vector<tree> branches = {};
  std::vector<std::pair<std::string, double>> leaves = {};
  std::vector<place> places = {};
  std::array<std::vector<place>, 2> sides = {};
  std::optional<std::string> note = {};
  std::tuple<int, std::string> last = {};
  std::int64_t number = 0;
  int not_sent = 7;

  using fields = field_list<&tree::name, &tree::branches, &tree::leaves, &tree::places, &tree::sides,
                            &tree::note, &tree::last, &tree::number>;
};

struct without_fields {
  std::vector<int> items;
};
struct with_a_pointer {
  const int* at = nullptr;
  using fields = field_list<&with_a_pointer::at>;
};

static_assert(encodable<tree> && encodable<std::vector<tree>> && encodable<std::optional<tree>>);
static_assert(encodable<place> && encodable<std::vector<std::array<int, 4>>> &&
              encodable<std::filesystem::path>);
static_assert(encodable<std::pair<int, std::string>> && encodable<std::array<std::string, 3>>);
static_assert(!encodable<int*> && !encodable<std::map<int, int>> && !encodable<without_fields> &&
              !encodable<std::vector<without_fields>> && !encodable<with_a_pointer>);

tree large() {
  return {.name = "root",
          .branches = {{.name = "", .number = -1}, {.name = "b", .branches = {{.name = "c"}}}},
          .leaves = {{"one", 1.5}, {"two", -2}},
          .places = {{1, 2}, {3, 4}},
          .sides = {std::vector<place>{{5, 6}}, std::vector<place>{}},
          .note = "kept",
          .last = {3, "three"},
          .number = std::numeric_limits<std::int64_t>::min(),
          .not_sent = 8};
}

} // namespace

TEST_CASE("A value comes back field by field, and those that are not listed as they are made") {
  const tree whole = large();
  const byte_buffer bytes = encoded(whole);
  byte_reader from(bytes);
  const auto back = decode<tree>(from);
  CHECK(from.at_end());
  CHECK(back.name == "root");
  REQUIRE(back.branches.size() == 2);
  CHECK(back.branches[0].number == -1);
  CHECK(back.branches[1].branches.at(0).name == "c");
  CHECK(back.leaves == whole.leaves);
  CHECK(back.places == whole.places);
  CHECK(back.sides == whole.sides);
  CHECK(back.note == whole.note);
  CHECK(!back.branches[0].note);
  CHECK(back.last == whole.last);
  CHECK(back.number == whole.number);
  CHECK(back.not_sent == 7);
  CHECK(encoded(back) == bytes);
}

TEST_CASE("Bytes cut short anywhere are an error") {
  const byte_buffer bytes = encoded(large());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK_THROWS_AS(
        (void)decoded<tree>(byte_buffer(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))),
        input_error);
}

TEST_CASE("No memory is asked for that the bytes cannot fill") {
  byte_writer to;
  to.count(std::numeric_limits<std::uint64_t>::max() / 2);
  to.value(1.0);
  const byte_buffer bytes = to.take();
  CHECK_THROWS_AS((void)decoded<std::vector<double>>(bytes), input_error);
  CHECK_THROWS_AS((void)decoded<std::string>(bytes), input_error);
  CHECK_THROWS_AS((void)decoded<std::vector<std::string>>(bytes), input_error);
}

TEST_CASE("Whole numbers of any size come back, and small ones take one byte") {
  std::mt19937_64 random(1);
  for (int k = 0; k < 10000; ++k) {
    const auto number = static_cast<std::int64_t>(random() >> (random() % 64));
    for (const std::int64_t each : {number, -number}) {
      CHECK(decoded<std::int64_t>(encoded(each)) == each);
      CHECK(decoded<std::uint64_t>(encoded(static_cast<std::uint64_t>(each))) ==
            static_cast<std::uint64_t>(each));
    }
  }
  for (const std::int64_t small : {-64, -1, 0, 1, 63})
    CHECK(encoded(small).size() == 1);
}
