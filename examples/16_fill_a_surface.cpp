/// The inside of a given triangulation, every triangle kept: a ball in a ball, two materials. Writes a VTU
/// file where one is named.
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/pipeline/fill.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <map>
#include <vector>

namespace {

using dovetail::local_id;
using dovetail::vec3;

/// The triangles of an octahedron, each divided in four `times` times, with all points on a sphere.
dovetail::simplicial_mesh<2> sphere(double radius, int times) {
  dovetail::simplicial_mesh<2> s{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
      {}};
  for (; times > 0; --times) {
    std::map<std::array<local_id, 2>, local_id> middles;
    const auto middle = [&](local_id a, local_id b) {
      const auto [place, is_new] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<local_id>(s.points.size()));
      if (is_new)
        s.points.push_back(0.5 * (s.points[a] + s.points[b]));
      return place->second;
    };
    std::vector<dovetail::simplex<2>> finer;
    for (const auto& [a, b, c] : s.elements) {
      const local_id ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t : {dovetail::simplex<2>{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(t);
    }
    s.elements = finer;
  }
  for (vec3& p : s.points)
    p = radius * normalized(p);
  return s;
}

} // namespace

int main(int argc, char** argv) {
  dovetail::simplicial_mesh<2> surface = sphere(2, 3);
  const dovetail::simplicial_mesh<2> inner = sphere(1, 3);
  const auto first = static_cast<local_id>(surface.points.size());
  surface.points.insert(surface.points.end(), inner.points.begin(), inner.points.end());
  for (const auto& [a, b, c] : inner.elements)
    surface.elements.push_back({a + first, b + first, c + first}); // turned over they would enclose a void

  // for the readme
  const dovetail::filled_surface filled = dovetail::fill(surface);
  for (const auto& region : filled.regions)
    std::printf("material %d: %zu tetrahedra, volume %.4f\n", region.material, region.elements,
                region.volume);
  // end
  std::printf("smallest dihedral angle %.1f degrees\n", filled.quality.min_dihedral_deg);
  if (argc > 1)
    dovetail::io::write_vtu(filled.mesh, argv[1]);
  return filled.regions.size() == 2 ? 0 : 1;
}
