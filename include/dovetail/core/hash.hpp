/// @file
/// A 64-bit content hash (FNV-1a over 8-byte words with a final mix); not cryptographic.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace dovetail {

/// Incremental hash; the same bytes in the same calls give the same value on every little-endian machine.
class content_hash {
public:
  /// Hashes eight bytes as a number.
  void word(std::uint64_t value) {
    state_ ^= value;
    state_ *= 0x9e3779b97f4a7c15ULL;
    state_ ^= state_ >> 32;
  }
  /// Hashes the bits of a number; -0 as 0.
  void number(double value) { word(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value)); }
  /// Hashes the number of bytes, then the bytes.
  void bytes(std::span<const std::byte> data) {
    word(data.size());
    std::size_t i = 0;
    for (; i + 8 <= data.size(); i += 8) {
      std::uint64_t value;
      std::memcpy(&value, data.data() + i, 8);
      word(value);
    }
    std::uint64_t tail = 0;
    if (i < data.size()) // an empty span may have no address
      std::memcpy(&tail, data.data() + i, data.size() - i);
    word(tail);
  }
  /// Hashes the characters as bytes.
  void text(std::string_view s) { bytes(std::as_bytes(std::span(s.data(), s.size()))); }

  /// The hash of all calls so far; more may follow.
  std::uint64_t value() const {
    std::uint64_t mixed = state_;
    mixed ^= mixed >> 33;
    mixed *= 0xff51afd7ed558ccdULL;
    mixed ^= mixed >> 33;
    return mixed;
  }

private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

} // namespace dovetail
