/// @file
/// What every communicator must do; each model's test calls this on all ranks.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/parallel/any_communicator.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <random>
#include <string>
#include <vector>

namespace contract {

using namespace dovetail;

/// Bytes that tell whose they are.
inline byte_buffer bytes_of(int rank, std::size_t size) {
  byte_buffer bytes(size);
  for (std::size_t k = 0; k < size; ++k)
    bytes[k] = static_cast<std::byte>((static_cast<std::size_t>(rank) * 31 + k * 7) & 0xff);
  return bytes;
}

/// Messages from one rank to another keep their order, each tag for itself.
inline void check_order(any_communicator all) {
  const auto even = all.next_tag();
  const auto odd = all.next_tag();
  for (int k = 0; k < 100; ++k)
    for (int to = 0; to < all.size(); ++to)
      if (to != all.rank()) {
        byte_writer text;
        text.value(k);
        all.send(to, k % 2 == 0 ? even : odd, text.take());
      }
  for (const auto tag : {odd, even}) {
    std::vector<int> next(static_cast<std::size_t>(all.size()), tag == even ? 0 : 1);
    for (int k = 0; k < 50 * (all.size() - 1); ++k) {
      const auto message = all.await(tag);
      int& expected = next[message.peer];
      REQUIRE(byte_reader(message.bytes).value<int>() == expected);
      expected += 2;
    }
    CHECK_FALSE(all.receive(tag));
  }
}

inline void check_collectives(any_communicator all) {
  const int size = all.size();
  for (int root = 0; root < size; ++root)
    for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, std::size_t{1000000}})
      REQUIRE(all.broadcast(all.rank() == root ? bytes_of(root, bytes) : byte_buffer{}, root) ==
              bytes_of(root, bytes));

  const auto gathered = all.all_gather(bytes_of(all.rank(), static_cast<std::size_t>(100 * all.rank())));
  REQUIRE(gathered.size() == static_cast<std::size_t>(size));
  for (int r = 0; r < size; ++r)
    CHECK(gathered[r] == bytes_of(r, static_cast<std::size_t>(100 * r)));

  const auto sums = all.exclusive_scan(std::int64_t{10000000000} + all.rank());
  CHECK(sums.before == std::int64_t{10000000000} * all.rank() + all.rank() * (all.rank() - 1) / 2);
  CHECK(sums.in_all == std::int64_t{10000000000} * size + size * (size - 1) / 2);
}

/// Every rank knows who sends to whom here, the communicator does not.
inline void check_exchanges(any_communicator all) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<rank_message> out, expected;
    for (int from = 0; from < all.size(); ++from)
      for (int to = 0; to < all.size(); ++to) {
        const std::size_t bytes = random() % 3 == 0 ? 0 : random() % 5000;
        if (random() % 2 == 0)
          continue;
        if (from == all.rank())
          out.push_back({.peer = to, .bytes = bytes_of(from, bytes)});
        if (to == all.rank())
          expected.push_back({.peer = from, .bytes = bytes_of(from, bytes)});
      }
    const auto in = all.exchange(out);
    REQUIRE(in.size() == expected.size());
    for (std::size_t k = 0; k < in.size(); ++k) {
      CHECK(in[k].peer == expected[k].peer);
      CHECK(in[k].bytes == expected[k].bytes);
    }
  }
}

/// The lowest rank's error is thrown by all, with its type.
inline void check_agreement(any_communicator all) {
  CHECK_NOTHROW(all.agree());
  std::exception_ptr failure;
  if (all.rank() == all.size() - 1)
    failure = std::make_exception_ptr(io_error("the last"));
  if (all.rank() == all.size() / 2)
    failure = std::make_exception_ptr(time_limit_error("the middle"));
  if (all.size() / 2 == all.size() - 1)
    CHECK_THROWS_WITH_AS(all.agree(failure), "the middle", time_limit_error);
  else
    CHECK_THROWS_WITH_AS(all.agree(failure), "the middle", mesher_error);
  CHECK_THROWS_AS(all.agree(std::make_exception_ptr(cancelled())), cancelled);
  CHECK_NOTHROW(all.agree());
}

inline void check_bad_receivers(any_communicator all) {
  for (const int to : {-1, all.rank(), all.size()})
    CHECK_THROWS_AS(all.send(to, 1, {}), usage_error);
}

inline void check_communicator(any_communicator all) {
  REQUIRE(all.rank() >= 0);
  REQUIRE(all.rank() < all.size());
  check_order(all);
  check_collectives(all);
  check_exchanges(all);
  check_agreement(all);
  check_bad_receivers(all);
}

} // namespace contract
