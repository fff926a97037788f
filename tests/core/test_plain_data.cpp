#include "dovetail/core/bytes.hpp"
#include "dovetail/core/hash.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/vector.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace dovetail;

TEST_CASE("what is written as bytes is read back, and an early end is an input_error") {
  byte_writer out;
  out.value(42);
  out.array(std::vector<vec3>{{1, 2, 3}, {4, 5, 6}});
  out.text("curve 7");
  out.array(std::vector<double>{});
  const byte_buffer buffer = out.take();

  byte_reader in(buffer);
  CHECK(in.value<int>() == 42);
  CHECK(in.array<vec3>() == std::vector<vec3>{{1, 2, 3}, {4, 5, 6}});
  CHECK(in.text() == "curve 7");
  CHECK(in.array<double>().empty());
  CHECK(in.at_end());
  CHECK_THROWS_AS(in.value<char>(), input_error);

  for (std::size_t size = 0; size < buffer.size(); ++size) {
    const byte_buffer cut(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
    byte_reader reader(cut);
    CHECK_THROWS_AS((reader.value<int>(), reader.array<vec3>(), reader.text(), reader.array<double>()),
                    input_error);
  }
}

TEST_CASE("an array length larger than the data is refused before anything is allocated") {
  byte_writer out;
  out.value(std::numeric_limits<std::uint64_t>::max());
  const byte_buffer buffer = out.take();
  byte_reader in(buffer);
  CHECK_THROWS_AS(in.array<double>(), input_error);
}

TEST_CASE("the hash depends on content and order, not on the sign of zero") {
  const auto hash_of = [](auto... values) {
    content_hash hash;
    (hash.number(values), ...);
    return hash.value();
  };
  CHECK(hash_of(1.0, 2.0) != hash_of(2.0, 1.0));
  CHECK(hash_of(0.0) == hash_of(-0.0));
  content_hash text, longer;
  text.text("abc");
  longer.text(std::string_view("abc\0", 4));
  CHECK(text.value() != longer.value());
}

TEST_CASE("report counters keep their order and are replaced by name") {
  report r;
  r.set("faces", 3);
  r.set("edges", 5);
  r.set("faces", 4);
  r.add("edges", 2);
  CHECK(r.counters.size() == 2);
  CHECK(r.counters.front().second == 4);
  CHECK(r.get("edges") == 7);
  CHECK(r.get("none", -1) == -1);
}

TEST_CASE("angles between vectors are accurate when tiny") {
  CHECK(angle_between({1, 0, 0}, {1, 1e-9, 0}) == doctest::Approx(1e-9));
  CHECK(signed_volume({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == doctest::Approx(1.0 / 6));
}
