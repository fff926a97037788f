/// @file
/// The name of a result: a hash of all that it is a function of.
#pragma once

#include "dovetail/core/hash.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace dovetail {

/// Same key, same bytes: results are kept under their keys, and what has not changed is not made again. Two
/// different results among a million share one of the 2^64 keys with a probability of 3e-8.
struct content_key {
  std::uint64_t value = 0; ///< the hash itself

  friend auto operator<=>(const content_key&, const content_key&) = default;
};

/// For containers: a key is a hash already.
struct content_key_hash {
  /// The key as it is.
  std::size_t operator()(content_key key) const { return static_cast<std::size_t>(key.value); }
};

/// As 16 hexadecimal digits.
std::string to_string(content_key key);

/// Hashes plain data into a key, one call after the other.
class key_maker {
public:
  /// Seeded with the keys of what else the result is a function of.
  template <class... Keys>
  explicit key_maker(Keys... on) {
    (hash_.word(on.value), ...);
  }

  /// Hashes the number of items and the items.
  template <class T>
  requires std::is_trivially_copyable_v<T> key_maker& operator()(const std::vector<T>& items) {
    hash_.word(items.size());
    hash_.bytes(std::as_bytes(std::span(items.data(), items.size())));
    return *this;
  }
  key_maker& operator()(std::int64_t number) {
    hash_.word(static_cast<std::uint64_t>(number));
    return *this;
  }
  key_maker& operator()(double number) {
    hash_.number(number);
    return *this;
  }
  content_key key() const { return {hash_.value()}; } ///< the key of all that was hashed so far

private:
  content_hash hash_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/core/content_key.ipp"
#endif
