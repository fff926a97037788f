// Bytes that a fuzzer makes up, as changes of a closed boundary: the native mesher fills it rightly or
// refuses it with a typed error, in bounded time and memory.
#include "dovetail/mesher/native.hpp"
#include "fuzz/byte_source.hpp"
#include "mesher/random_pieces.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

using namespace dovetail;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::byte_source bytes(data, size);
  const unsigned kind = bytes.byte();
  auto boundary = fuzz::closed_boundary(kind);
  const auto vertex = [&] { return static_cast<local_id>(bytes.byte() % boundary.points.size()); };
  while (!bytes.empty()) {
    const std::size_t what = bytes.byte();
    if (what == 255) { // a triangle more, in one direction
      const local_id a = vertex(), b = vertex(), c = vertex();
      boundary.elements.push_back({a, b, c});
    } else if (what == 254) { // a wall, in both
      const local_id a = vertex(), b = vertex(), c = vertex();
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
