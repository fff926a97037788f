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

/// Two's complement, least significant word first. Sums wrap around: whoever adds knows that they fit.
template <std::size_t Words>
struct wide_integer {
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

  friend constexpr wide_integer operator+(const wide_integer& a, const wide_integer& b) {
    wide_integer sum;
    two_words carry = 0;
    for (std::size_t i = 0; i < Words; ++i) {
      carry += two_words{a.words[i]} + b.words[i];
      sum.words[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64U;
    }
    return sum;
  }
  friend constexpr wide_integer operator-(const wide_integer& a, const wide_integer& b) {
    wide_integer difference;
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
constexpr void subtract_shifted(wide_integer<N>& from, const wide_integer<B>& b) {
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
constexpr wide_integer<A + B> operator*(const wide_integer<A>& a, const wide_integer<B>& b) {
  wide_integer<A + B> product;
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

/// The differences a[i] - b[i] as multiples, below 2^61, of a unit of their own: the sign of a homogeneous
/// polynomial of them is that of the same polynomial of the integers. False when rounding would be needed.
template <std::size_t N>
bool integer_differences(const std::array<double, N>& a, const std::array<double, N>& b,
                         std::array<wide_integer<1>, N>& integers) {
  std::array<double, N> differences;
  double largest = 0;
  bool exact = true;
  for (std::size_t i = 0; i < N; ++i) {
    const double difference = a[i] - b[i];
    const double virtual_part = a[i] - difference;
    exact = exact && (a[i] - (difference + virtual_part)) + (virtual_part - b[i]) == 0;
    differences[i] = difference;
    largest = std::abs(difference) > largest ? std::abs(difference) : largest;
  }
  constexpr double least = 1e-200, most = 1e200; // far from where the unit is no normal number
  if (!exact || !(largest < most) || (largest < least && largest != 0))
    return false;
  const std::uint64_t exponent = largest == 0 ? 1023 : std::bit_cast<std::uint64_t>(largest) >> 52U;
  const auto scale = std::bit_cast<double>((std::uint64_t{2 * 1023 + 60} - exponent) << 52U);
  for (std::size_t i = 0; i < N; ++i) {
    const double scaled = differences[i] * scale;
    const auto integer = static_cast<std::int64_t>(scaled);
    exact = exact && static_cast<double>(integer) == scaled;
    integers[i].words[0] = static_cast<std::uint64_t>(integer);
  }
  return exact;
}

} // namespace dovetail::detail
