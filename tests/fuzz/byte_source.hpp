/// @file
/// The bytes that a fuzzer makes up, as numbers and places, and a closed boundary that they change.
#pragma once

#include "mesher/random_pieces.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace fuzz {

using namespace dovetail;

/// Takes the input apart from its begin; zeros follow it.
class byte_source {
public:
  byte_source(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return size_ == 0; }
  std::uint8_t byte() {
    if (size_ == 0)
      return 0;
    --size_;
    return *data_++;
  }
  /// On a grid of 256, so that points come to lie on each other, on lines and in planes; sometimes any
  /// number.
  double coordinate() {
    const std::uint8_t first = byte();
    if (first != 255)
      return first / 64.0;
    std::uint64_t bits = 0;
    for (int k = 0; k < 8; ++k)
      bits = bits << 8 | byte();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    constexpr double largest = 1e10; // products of larger ones overflow
    return std::abs(value) > largest && std::isfinite(value) ? largest : value;
  }

private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// The closed boundary of the given kind, of four.
inline shapes::surface closed_boundary(unsigned kind) {
  switch (kind % 4) {
  case 0:
    return shapes::cube(2);
  case 1:
    return shapes::sphere(1);
  case 2:
    return shapes::torus(4);
  default:
    return random_pieces::tower({random_pieces::ring(5, 1, 0, 0), random_pieces::ring(5, 1, -0.5, 1)});
  }
}

} // namespace fuzz
