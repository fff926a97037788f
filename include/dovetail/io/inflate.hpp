/// @file
/// Decompression of zlib streams (RFC 1950 and 1951), which VTK uses in its compressed files.
#pragma once

#include "dovetail/core/error.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dovetail::io {

namespace detail {

/// Bits of a deflate stream, lowest first.
class bit_stream {
public:
  explicit bit_stream(std::span<const std::uint8_t> data) : data_(data) {}

  std::uint32_t bits(int count) {
    while (held_ < count) {
      if (at_ == data_.size())
        throw input_error("compressed data end early");
      buffer_ |= static_cast<std::uint64_t>(data_[at_++]) << held_;
      held_ += 8;
    }
    const auto value = static_cast<std::uint32_t>(buffer_ & ((std::uint64_t{1} << count) - 1));
    buffer_ >>= count;
    held_ -= count;
    return value;
  }
  void to_byte_boundary() { bits(held_ % 8); }

private:
  std::span<const std::uint8_t> data_;
  std::size_t at_ = 0;
  std::uint64_t buffer_ = 0;
  int held_ = 0;
};

/// A canonical Huffman code: symbols ordered by code length, then by value.
class huffman_code {
public:
  explicit huffman_code(std::span<const std::uint8_t> lengths) {
    for (const auto length : lengths)
      ++count_[length];
    count_[0] = 0;
    std::array<std::uint16_t, 16> next{};
    int unused = 1; // codes of the present length that no symbol has
    for (std::size_t length = 1; length < 16; ++length) {
      unused = 2 * unused - count_[length];
      if (unused < 0)
        throw input_error("compressed data are damaged: impossible code lengths");
      next[length] = static_cast<std::uint16_t>(next[length - 1] + count_[length - 1]);
    }
    symbols_.resize(lengths.size());
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol)
      if (lengths[symbol] != 0)
        symbols_[next[lengths[symbol]]++] = static_cast<std::uint16_t>(symbol);
  }
  std::uint32_t symbol(bit_stream& stream) const {
    int code = 0;  // the bits read so far
    int first = 0; // the first code of this length
    int index = 0; // of its symbol
    for (std::size_t length = 1; length < 16; ++length) {
      code |= static_cast<int>(stream.bits(1));
      const int count = count_[length];
      if (code - count < first)
        return symbols_[static_cast<std::size_t>(index + code - first)];
      index += count;
      first = (first + count) << 1;
      code <<= 1;
    }
    throw input_error("compressed data are damaged: a code that no symbol has");
  }

private:
  std::array<std::uint16_t, 16> count_{};
  std::vector<std::uint16_t> symbols_;
};

/// The codes of blocks that bring none of their own.
inline std::pair<huffman_code, huffman_code> fixed_codes() {
  std::array<std::uint8_t, 288> literals;
  for (std::size_t symbol = 0; symbol < literals.size(); ++symbol)
    literals[symbol] = symbol < 144 ? 8 : symbol < 256 ? 9 : symbol < 280 ? 7 : 8;
  std::array<std::uint8_t, 30> distances;
  distances.fill(5);
  return {huffman_code(literals), huffman_code(distances)};
}

/// Reads the codes of a block: their lengths are themselves coded.
inline std::pair<huffman_code, huffman_code> dynamic_codes(bit_stream& stream) {
  constexpr std::array<std::uint8_t, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                               11, 4,  12, 3, 13, 2, 14, 1, 15};
  const std::size_t literals = stream.bits(5) + 257;
  const std::size_t distances = stream.bits(5) + 1;
  const std::size_t coded = stream.bits(4) + 4;
  std::array<std::uint8_t, 19> length_lengths{};
  for (std::size_t i = 0; i < coded; ++i)
    length_lengths[order[i]] = static_cast<std::uint8_t>(stream.bits(3));
  const huffman_code length_code(length_lengths);

  std::vector<std::uint8_t> lengths;
  while (lengths.size() < literals + distances) {
    const auto symbol = length_code.symbol(stream);
    if (symbol < 16) {
      lengths.push_back(static_cast<std::uint8_t>(symbol));
      continue;
    }
    if (symbol == 16 && lengths.empty())
      throw input_error("compressed data are damaged: a repeated length without a first one");
    const std::uint8_t value = symbol == 16 ? lengths.back() : std::uint8_t{0};
    const auto repeat = symbol == 16   ? 3 + stream.bits(2)
                        : symbol == 17 ? 3 + stream.bits(3)
                                       : 11 + stream.bits(7);
    lengths.insert(lengths.end(), repeat, value);
  }
  if (lengths.size() != literals + distances)
    throw input_error("compressed data are damaged: too many code lengths");
  const std::span all(lengths);
  return {huffman_code(all.first(literals)), huffman_code(all.subspan(literals))};
}

/// Expands one block that is coded by `literals` and `distances`.
inline void inflate_block(bit_stream& stream, const huffman_code& literals, const huffman_code& distances,
                          std::vector<std::uint8_t>& out, std::size_t limit) {
  constexpr std::array<std::uint16_t, 29> length_base{3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                                      15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                                      67, 83, 99, 115, 131, 163, 195, 227, 258};
  constexpr std::array<std::uint8_t, 29> length_bits{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                     2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
  constexpr std::array<std::uint16_t, 30> distance_base{
      1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
      193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
  constexpr std::array<std::uint8_t, 30> distance_bits{0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                                       6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};
  constexpr std::uint32_t end_of_block = 256;
  for (;;) {
    const auto symbol = literals.symbol(stream);
    if (symbol == end_of_block)
      return;
    if (symbol < end_of_block) {
      if (out.size() == limit)
        throw input_error("compressed data are longer than announced");
      out.push_back(static_cast<std::uint8_t>(symbol));
      continue;
    }
    const auto kind = symbol - 257;
    if (kind >= length_base.size())
      throw input_error("compressed data are damaged: an unknown length");
    const std::size_t length = length_base[kind] + stream.bits(length_bits[kind]);
    const auto far = distances.symbol(stream);
    if (far >= distance_base.size())
      throw input_error("compressed data are damaged: an unknown distance");
    const std::size_t distance = distance_base[far] + stream.bits(distance_bits[far]);
    if (distance > out.size())
      throw input_error("compressed data are damaged: a distance before the start");
    if (length > limit - out.size())
      throw input_error("compressed data are longer than announced");
    for (std::size_t i = 0; i < length; ++i)
      out.push_back(out[out.size() - distance]);
  }
}

inline void inflate_stored(bit_stream& stream, std::vector<std::uint8_t>& out, std::size_t limit) {
  stream.to_byte_boundary();
  const auto length = stream.bits(16);
  if ((stream.bits(16) ^ 0xffffU) != length)
    throw input_error("compressed data are damaged: a stored block of unclear length");
  if (length > limit - out.size())
    throw input_error("compressed data are longer than announced");
  for (std::uint32_t i = 0; i < length; ++i)
    out.push_back(static_cast<std::uint8_t>(stream.bits(8)));
}

/// The checksum at the end of a zlib stream.
inline std::uint32_t adler32(std::span<const std::uint8_t> data) {
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const auto byte : data) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

} // namespace detail

/// Expands a zlib stream to exactly `size` bytes; throws `input_error` when the stream is damaged or gives
/// another size.
inline std::vector<std::uint8_t> inflate_zlib(std::span<const std::uint8_t> data, std::size_t size) {
  // Deflate expands at most 1032 times: a larger size is an error, not a reason to allocate.
  if (size / 1032 > data.size())
    throw input_error("compressed data end early");
  detail::bit_stream stream(data);
  const auto method = stream.bits(8);
  const auto flags = stream.bits(8);
  if ((method & 15U) != 8 || (256 * method + flags) % 31 != 0 || (flags & 32U) != 0)
    throw input_error("compressed data are not a zlib stream");
  std::vector<std::uint8_t> out;
  out.reserve(size);
  for (bool last = false; !last;) {
    last = stream.bits(1) == 1;
    switch (stream.bits(2)) {
    case 0:
      detail::inflate_stored(stream, out, size);
      break;
    case 1: {
      const auto [literals, distances] = detail::fixed_codes();
      detail::inflate_block(stream, literals, distances, out, size);
      break;
    }
    case 2: {
      const auto [literals, distances] = detail::dynamic_codes(stream);
      detail::inflate_block(stream, literals, distances, out, size);
      break;
    }
    default:
      throw input_error("compressed data are damaged: an unknown kind of block");
    }
  }
  stream.to_byte_boundary();
  std::uint32_t checksum = 0;
  for (int i = 0; i < 4; ++i)
    checksum = checksum << 8 | stream.bits(8);
  if (out.size() != size || checksum != detail::adler32(out))
    throw input_error("compressed data are damaged: size or checksum is wrong");
  return out;
}

} // namespace dovetail::io
