/// @file
/// The names of results. A stage says what a result is a function of; where it lies then (in memory, on a
/// disk, with another rank) is the business of the executor that it is made through.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/core/hash.hpp"

#include <compare>
#include <cstddef>

namespace dovetail {

/// Names a result by what it is a function of, beside what is the same for all of a run: model, plain sizes,
/// policies. Same name, same result.
template <class Result>
class kept {
public:
  kept() = default; ///< of no result
  explicit kept(content_key key) : key_(key) {}

  /// Of what is a function of these, byte by byte: 0 and -0 are two. Linear in their size.
  template <encodable... Inputs>
  static kept of(const Inputs&... inputs) {
    constexpr std::size_t mostly_enough = 256;
    byte_writer bytes;
    bytes.reserve(mostly_enough);
    (encode(bytes, inputs), ...);
    content_hash hash;
    hash.bytes(bytes.take());
    return kept(content_key{hash.value()});
  }

  content_key key() const { return key_; } ///< what stores call it

  friend auto operator<=>(const kept&, const kept&) = default;

private:
  content_key key_ = {};
};

/// For containers: a name is a hash already.
struct kept_hash {
  /// That of its key.
  template <class Result>
  std::size_t operator()(const kept<Result>& result) const {
    return content_key_hash{}(result.key());
  }
};

} // namespace dovetail
