// Bytes that a fuzzer makes up, as changes of closed shells, as sizes and as marks: `fill` fills what they
// enclose rightly or refuses it with a typed error, in bounded time and memory.
#include "dovetail/pipeline/fill.hpp"
#include "fuzz/byte_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

/// Shells that bytes have moved, turned over, opened and joined by walls.
shapes::surface surface_of(fuzz::byte_source& bytes, std::size_t changes) {
  const unsigned kind = bytes.byte();
  auto s = fuzz::closed_boundary(kind);
  if ((kind & 64U) != 0) { // another shell, inside of most of the first ones
    auto inner = fuzz::closed_boundary(kind / 4);
    for (vec3& p : inner.points)
      p = (kind & 32U) != 0 ? vec3{0.4, 0.4, 0.4} + 0.1 * p : 0.3 * p;
    shapes::append(s, inner, (kind & 16U) != 0);
  }
  const auto vertex = [&] { return static_cast<local_id>(bytes.byte() % (s.points.size() + 1)); };
  for (; changes > 0 && !bytes.empty(); --changes) {
    const std::size_t what = bytes.byte();
    if (what == 255) { // a wall, or a part of one
      const local_id a = vertex(), b = vertex(), c = vertex();
      s.elements.push_back({a, b, c});
    } else if (what == 254) {
      simplex<2>& t = s.elements[bytes.byte() % s.elements.size()];
      std::swap(t[1], t[2]);
    } else if (what == 253) {
      const std::size_t t = bytes.byte() % s.elements.size();
      if (s.elements.size() > 1)
        s.elements.erase(s.elements.begin() + static_cast<std::ptrdiff_t>(t));
    } else if (what == 252) { // a pocket or a bump on a triangle
      const simplex<2> t = s.elements[bytes.byte() % s.elements.size()];
      if (*std::max_element(t.begin(), t.end()) >= static_cast<local_id>(s.points.size()))
        continue;
      const auto tip = static_cast<local_id>(s.points.size());
      s.points.push_back({bytes.coordinate(), bytes.coordinate(), bytes.coordinate()});
      s.elements.push_back({t[0], t[1], tip});
      s.elements.push_back({t[1], t[2], tip});
      s.elements.push_back({t[2], t[0], tip});
    } else {
      s.points[what % s.points.size()] = {bytes.coordinate(), bytes.coordinate(), bytes.coordinate()};
    }
  }
  return s;
}

/// Empty when all is as `fill` promises: the surface's points bit for bit and first, positive elements, each
/// triangle a side of one of the material that it is said to have on either side and of no other, no other
/// side with elements on one side only, and regions as large as their elements.
std::string fault_of(const shapes::surface& given, const filled_surface& made) {
  const auto& mesh = made.mesh;
  if (mesh.points.size() < given.points.size() || // bits: a point that no triangle has may be no number
      std::memcmp(mesh.points.data(), given.points.data(), given.points.size() * sizeof(vec3)) != 0)
    return "points have changed";
  if (mesh.tags.size() != mesh.elements.size() || made.materials_beside.size() != given.elements.size())
    return "something has not its number of entries";
  std::map<simplex<2>, std::array<std::vector<local_id>, 2>> materials; // behind sides of either parity
  std::map<local_id, std::size_t> count;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& v = mesh.elements[e];
    const auto at = [&](std::size_t k) { return mesh.points[v[k]]; };
    if (!(orient3d(at(0), at(1), at(2), at(3)) > 0))
      return "an element is not positive";
    ++count[mesh.tags[e]];
    for (const auto& local : numbering::sides<3>) {
      const simplex<2> side{v[local[0]], v[local[1]], v[local[2]]};
      materials[sorted_vertices(side)][boundary_sides::parity(side)].push_back(mesh.tags[e]);
    }
  }
  for (std::size_t t = 0; t < given.elements.size(); ++t) {
    const auto& triangle = given.elements[t];
    const auto found = materials.extract(sorted_vertices(triangle));
    if (found.empty())
      return "a triangle is no side";
    const auto parity = static_cast<std::size_t>(boundary_sides::parity(triangle));
    for (std::size_t k = 0; k < 2; ++k) {
      const local_id said = made.materials_beside[t][k];
      const auto& there = found.mapped()[k == 0 ? parity : 1 - parity];
      if (there != (said == no_id ? std::vector<local_id>{} : std::vector<local_id>{said}))
        return "beside a triangle is another material than is said";
    }
  }
  for (const auto& [side, beside] : materials)
    if (beside[0].size() != 1 || beside[0] != beside[1])
      return "a side inside has not one element of one material on either side";
  std::map<local_id, std::size_t> said;
  for (const filled_region& region : made.regions) {
    said[region.material] += region.elements;
    if (!(region.volume > 0))
      return "a region has no volume";
  }
  return said == count ? "" : "regions have other numbers of elements than are there";
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::byte_source bytes(data, size);
  const unsigned how = bytes.byte();
  fill_options options;
  options.largest_prediction = 5000; // so that one input takes a second or two at most
  const std::size_t marks = how % 4;
  for (std::size_t k = 0; k < marks; ++k) {
    const vec3 place{bytes.coordinate(), bytes.coordinate(), bytes.coordinate()};
    options.marks.push_back({place, static_cast<local_id>(bytes.byte() % 8) - 1});
  }
  const double h = (how & 32U) != 0 ? bytes.coordinate() : 0.5;
  if ((how & 64U) != 0)
    options.growth = bytes.coordinate();
  const auto surface = surface_of(bytes, 256);
  try {
    const auto made = (how & 16U) != 0 ? fill(
                                             surface, [h](vec3) { return h; }, options)
                                       : fill(surface, options);
    if (const std::string fault = fault_of(surface, made); !fault.empty()) {
      std::fprintf(stderr, "%s\n", fault.c_str());
      std::abort();
    }
  } catch (const error&) { // any other exception ends the fuzzer
  }
  return 0;
}
