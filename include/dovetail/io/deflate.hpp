/// @file
/// Compression to zlib streams (RFC 1950 and 1951): repeated strings, coded by the format's fixed code. Less
/// tight than codes made for the data, and as good for pictures of few colours.
#pragma once

#include "dovetail/io/inflate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// Writes the bits of a deflate stream, lowest first.
class bit_sink {
public:
  explicit bit_sink(std::vector<std::uint8_t>& out) : out_(out) {}

  void bits(std::uint32_t value, int count) {
    buffer_ |= static_cast<std::uint64_t>(value) << held_;
    held_ += count;
    for (; held_ >= 8; held_ -= 8) {
      out_.push_back(static_cast<std::uint8_t>(buffer_ & 255));
      buffer_ >>= 8;
    }
  }
  /// Huffman codes are stored from their highest bit on.
  void code(std::uint32_t value, int count) {
    std::uint32_t reversed = 0;
    for (int k = 0; k < count; ++k)
      reversed |= (value >> k & 1U) << (count - 1 - k);
    bits(reversed, count);
  }
  void to_byte_boundary() {
    if (held_ > 0)
      bits(0, 8 - held_);
  }

private:
  std::vector<std::uint8_t>& out_;
  std::uint64_t buffer_ = 0;
  int held_ = 0;
};

/// A literal, a length or the end of the block in the fixed code.
inline void put_symbol(bit_sink& sink, std::uint32_t symbol) {
  if (symbol < 144)
    sink.code(0x30 + symbol, 8);
  else if (symbol < 256)
    sink.code(0x190 + symbol - 144, 9);
  else if (symbol < 280)
    sink.code(symbol - 256, 7);
  else
    sink.code(0xc0 + symbol - 280, 8);
}

/// A repetition of 3 to 258 bytes that stand 1 to 32768 bytes before. The classes of lengths and distances
/// double in width every four and every two symbols.
inline void put_repetition(bit_sink& sink, std::size_t length, std::size_t distance) {
  const auto more = static_cast<std::uint32_t>(length - 3);
  if (length == 258) {
    put_symbol(sink, 285);
  } else if (more < 8) {
    put_symbol(sink, 257 + more);
  } else {
    const int extra = static_cast<int>(std::bit_width(more)) - 3;
    put_symbol(sink, 257 + 4 * (static_cast<std::uint32_t>(extra) + 1) + (more >> extra & 3U));
    sink.bits(more & ((1U << extra) - 1), extra);
  }
  const auto back = static_cast<std::uint32_t>(distance - 1);
  if (back < 4) {
    sink.code(back, 5);
  } else {
    const int extra = static_cast<int>(std::bit_width(back)) - 2;
    sink.code(2 * (static_cast<std::uint32_t>(extra) + 1) + (back >> extra & 1U), 5);
    sink.bits(back & ((1U << extra) - 1), extra);
  }
}

/// Finds earlier occurrences of the bytes at a place, by chains of places whose next three bytes hash alike.
class repetition_finder {
public:
  struct repetition {
    std::size_t length = 0; ///< 0: none of at least three bytes
    std::size_t distance = 0;
  };

  explicit repetition_finder(std::span<const std::uint8_t> data)
      : data_(data), first_(std::size_t{1} << hash_bits, none), next_(data.size(), none) {}

  /// The longest of the latest few occurrences; the nearest of equally long ones.
  repetition longest_at(std::size_t at) const {
    repetition best;
    if (at + shortest > data_.size())
      return best;
    const std::size_t limit = std::min<std::size_t>(258, data_.size() - at);
    std::uint32_t candidate = first_[hash_at(at)];
    for (int tries = 0; tries < chain_limit && candidate != none && at - candidate <= window; ++tries) {
      const auto here = data_.begin() + static_cast<std::ptrdiff_t>(at);
      const auto there = data_.begin() + candidate;
      const auto length = static_cast<std::size_t>(
          std::mismatch(here, here + static_cast<std::ptrdiff_t>(limit), there).first - here);
      if (length >= shortest && length > best.length)
        best = {length, at - candidate};
      if (best.length == limit)
        break;
      candidate = next_[candidate];
    }
    return best;
  }
  /// From now on the bytes at `at` can be repeated.
  void insert(std::size_t at) {
    if (at + shortest <= data_.size())
      next_[at] = std::exchange(first_[hash_at(at)], static_cast<std::uint32_t>(at));
  }

private:
  static constexpr std::size_t shortest = 3;
  static constexpr std::size_t window = 32768;
  static constexpr int hash_bits = 15;
  static constexpr int chain_limit = 32;
  static constexpr std::uint32_t none = 0xffffffff;

  std::size_t hash_at(std::size_t at) const {
    const std::uint32_t bytes = static_cast<std::uint32_t>(data_[at]) << 16 |
                                static_cast<std::uint32_t>(data_[at + 1]) << 8 | data_[at + 2];
    return (bytes * 2654435761U) >> (32 - hash_bits);
  }

  std::span<const std::uint8_t> data_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
};

} // namespace detail

/// Compresses bytes to a zlib stream that `inflate_zlib` expands again. Linear; holds 4 bytes per byte of
/// input, of which there must be less than 4 GiB. Throws `usage_error` for more.
inline std::vector<std::uint8_t> deflate_zlib(std::span<const std::uint8_t> data) {
  if (data.size() >= 0xffffffff)
    throw usage_error("compression: " + std::to_string(data.size()) +
                      " bytes are too many at once; give less than 4 GiB");
  std::vector<std::uint8_t> out{0x78, 0x01}; // deflate with a window of 32 KiB; no preset dictionary
  detail::bit_sink sink(out);
  sink.bits(1, 1); // the last block
  sink.bits(1, 2); // of the fixed code
  detail::repetition_finder finder(data);
  for (std::size_t at = 0; at < data.size();) {
    const auto [length, distance] = finder.longest_at(at);
    if (length == 0)
      detail::put_symbol(sink, data[at]);
    else
      detail::put_repetition(sink, length, distance);
    for (const std::size_t end = at + std::max<std::size_t>(length, 1); at < end; ++at)
      finder.insert(at);
  }
  detail::put_symbol(sink, 256);
  sink.to_byte_boundary();
  const std::uint32_t checksum = detail::adler32(data);
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(checksum >> shift & 255U));
  return out;
}

} // namespace dovetail::io
