/// @file
/// Signed integers of a fixed number of 64-bit words, as wide as a product of theirs needs: exact arithmetic
/// for determinants of integers without any branch or memory.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace dovetail::detail {

__extension__ using two_words = unsigned __int128;
__extension__ using signed_two_words = __int128;

/// Two's complement, least significant word first. Sums wrap around: whoever adds knows that they fit.
template <std::size_t Words>
struct fixed_integer {
  std::array<std::uint64_t, Words> words{};

  constexpr bool negative() const { return words[Words - 1] >> 63U != 0; }
  constexpr double sign() const {
    if (negative())
      return -1;
    for (const std::uint64_t word : words)
      if (word != 0)
        return 1;
    return 0;
  }

  friend constexpr fixed_integer operator+(const fixed_integer& a, const fixed_integer& b) {
    fixed_integer sum;
    two_words carry = 0;
    for (std::size_t i = 0; i < Words; ++i) {
      carry += two_words{a.words[i]} + b.words[i];
      sum.words[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64U;
    }
    return sum;
  }
  friend constexpr fixed_integer operator-(const fixed_integer& a, const fixed_integer& b) {
    fixed_integer difference;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < Words; ++i) {
      const two_words value = two_words{a.words[i]} - b.words[i] - borrow;
      difference.words[i] = static_cast<std::uint64_t>(value);
      borrow = static_cast<std::uint64_t>(value >> 64U) & 1U;
    }
    return difference;
  }
};

/// Subtracts `b` shifted by whole words, from `Shift` on.
template <std::size_t Shift, std::size_t N, std::size_t B>
constexpr void subtract_shifted(fixed_integer<N>& from, const fixed_integer<B>& b) {
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < B && Shift + i < N; ++i) {
    const two_words value = two_words{from.words[Shift + i]} - b.words[i] - borrow;
    from.words[Shift + i] = static_cast<std::uint64_t>(value);
    borrow = static_cast<std::uint64_t>(value >> 64U) & 1U;
  }
}

/// The exact product. A negative factor, read as if it had no sign, is larger by 2^(64 words): the other
/// factor, shifted, is taken off again.
template <std::size_t A, std::size_t B>
constexpr fixed_integer<A + B> operator*(const fixed_integer<A>& a, const fixed_integer<B>& b) {
  fixed_integer<A + B> product;
  for (std::size_t i = 0; i < A; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < B; ++j) {
      const two_words value = two_words{a.words[i]} * b.words[j] + product.words[i + j] + carry;
      product.words[i + j] = static_cast<std::uint64_t>(value);
      carry = static_cast<std::uint64_t>(value >> 64U);
    }
    product.words[i + B] = carry;
  }
  if (a.negative())
    subtract_shifted<A>(product, b);
  if (b.negative())
    subtract_shifted<B>(product, a);
  return product;
}

/// The integer that a double is, if it is one below 2^(64 Words - 1).
template <std::size_t Words>
fixed_integer<Words> whole_number(double value) {
  fixed_integer<Words> result;
  if constexpr (Words == 1) {
    result.words[0] = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  } else {
    const auto integer = static_cast<two_words>(static_cast<signed_two_words>(value));
    result.words[0] = static_cast<std::uint64_t>(integer);
    result.words[1] = static_cast<std::uint64_t>(integer >> 64U);
  }
  return result;
}

/// The differences a[i] - b[i] as multiples, of at most 61 bits for one word and 124 for two, of a unit of
/// their own: the sign of a homogeneous polynomial of them is that of the same polynomial of the integers.
/// False when that would need rounding.
template <std::size_t Words, std::size_t N>
bool integer_differences(const std::array<double, N>& a, const std::array<double, N>& b,
                         std::array<fixed_integer<Words>, N>& integers) {
  static_assert(Words == 1 || Words == 2);
  std::array<double, N> differences, rests;
  double largest = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const double difference = a[i] - b[i];
    const double virtual_part = a[i] - difference;
    differences[i] = difference;
    rests[i] = (a[i] - (difference + virtual_part)) + (virtual_part - b[i]);
    largest = std::abs(difference) > largest ? std::abs(difference) : largest;
  }
  constexpr double least = 1e-200, most = 1e200; // far from where the unit is no normal number
  if (!(largest < most) || (largest < least && largest != 0))
    return false;
  constexpr std::uint64_t bits = Words == 1 ? 60 : 123;
  const std::uint64_t exponent = largest == 0 ? 1023 : std::bit_cast<std::uint64_t>(largest) >> 52U;
  const auto scale = std::bit_cast<double>((2 * 1023 + bits - exponent) << 52U);
  const auto is_whole = [](double value) { // one of 2^53 and more always is
    constexpr double no_fraction = 0x1p53;
    return std::abs(value) >= no_fraction || static_cast<double>(static_cast<std::int64_t>(value)) == value;
  };
  bool exact = true;
  for (std::size_t i = 0; i < N; ++i) {
    const double scaled = differences[i] * scale, rest = rests[i] * scale;
    exact = exact && is_whole(scaled) && is_whole(rest);
    integers[i] = whole_number<Words>(scaled) + whole_number<Words>(rest);
  }
  return exact;
}

} // namespace dovetail::detail
