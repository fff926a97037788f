/// @file
/// Small numbers and short texts in few bytes, for what is sent of each of many pieces.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"

#include <cstdint>
#include <string>

namespace dovetail {

/// Seven bits to a byte, so that a number below 128 takes one.
inline void encode_count(byte_writer& to, std::uint64_t number) {
  for (; number >= 128; number >>= 7)
    to.value(static_cast<std::uint8_t>(number | 128));
  to.value(static_cast<std::uint8_t>(number));
}

/// Throws `input_error` when the data end early or are no number of 64 bits.
inline std::uint64_t decode_count(byte_reader& from) {
  std::uint64_t number = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const auto next = from.value<std::uint8_t>();
    number |= static_cast<std::uint64_t>(next & 127) << shift;
    if (next < 128)
      return number;
  }
  throw input_error("binary data have a number of more than 64 bits");
}

inline void encode_short(byte_writer& to, const std::string& text) {
  encode_count(to, text.size());
  for (const char c : text)
    to.value(c);
}

inline std::string decode_short(byte_reader& from) {
  std::string text;
  for (auto left = decode_count(from); left > 0; --left)
    text += from.value<char>();
  return text;
}

} // namespace dovetail
