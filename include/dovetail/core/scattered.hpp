/// @file
/// Numbers that look random and are the same in every run and on every machine.
#pragma once

#include "dovetail/core/vector.hpp"

#include <cstdint>

namespace dovetail::detail {

/// A number that looks random and is the same for the same index (the finalizer of MurmurHash3).
constexpr std::uint64_t scattered(std::uint64_t index) {
  std::uint64_t h = index + 0x9e3779b97f4a7c15ULL;
  h = (h ^ (h >> 33U)) * 0xff51afd7ed558ccdULL;
  h = (h ^ (h >> 33U)) * 0xc4ceb9fe1a85ec53ULL;
  return h ^ (h >> 33U);
}

/// A vector in the cube from -1 to 1, for each index another one.
constexpr vec3 scattered_vector(std::uint64_t index) {
  const auto coordinate = [h = scattered(index)](unsigned shift) {
    constexpr double half = 1U << 20U;
    return static_cast<double>(h >> shift & 0x1fffffU) / half - 1;
  };
  return {coordinate(0), coordinate(21), coordinate(42)};
}

} // namespace dovetail::detail
