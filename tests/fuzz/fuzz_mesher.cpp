// Bytes that a fuzzer makes up, as changes of a closed boundary: the native mesher fills it rightly or
// refuses it with a typed error, in bounded time and memory.
#include "dovetail/mesher/native.hpp"
#include "mesher/random_pieces.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

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

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  byte_source bytes(data, size);
  const unsigned kind = bytes.byte();
  auto boundary =
      kind % 4 == 0   ? shapes::cube(2)
      : kind % 4 == 1 ? shapes::sphere(1)
      : kind % 4 == 2
          ? shapes::torus(4)
          : random_pieces::tower({random_pieces::ring(5, 1, 0, 0), random_pieces::ring(5, 1, -0.5, 1)});
  while (!bytes.empty()) {
    const std::size_t what = bytes.byte();
    if (what == 255) { // a triangle more, in one direction
      const local_id a = bytes.byte(), b = bytes.byte(), c = bytes.byte();
      boundary.elements.push_back({a, b, c});
    } else if (what == 254) { // a wall, in both
      const local_id a = bytes.byte(), b = bytes.byte(), c = bytes.byte();
      boundary.elements.push_back({a, b, c});
      boundary.elements.push_back({a, c, b});
    } else {
      vec3& p = boundary.points[what % boundary.points.size()];
      p = {bytes.coordinate(), bytes.coordinate(), bytes.coordinate()};
    }
  }
  try {
    box3 box;
    for (const vec3 p : boundary.points)
      box.include(p);
    const double h = (kind < 128 ? 1e3 : 0.2) * box.diagonal();
    const auto result = mesher::native{}({boundary, 0}, [h](vec3) { return h; });
    if (!random_pieces::fault_of(boundary, result.mesh).empty())
      std::abort();
  } catch (const error&) { // any other exception ends the fuzzer
  }
  return 0;
}
