#include "dovetail/core/encoding.hpp"
#include "dovetail/mesh/quality_at_interfaces.hpp"
#include "dovetail/mesh/skeleton_index.hpp"
#include "dovetail/meshing/subdomain_surface.hpp"
#include "files/distribute.hpp"
#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace dovetail;

namespace {

/// A cube of six layers of cells along x, of which the given ones are of subdomain 1.
quality_at_interfaces of_layers(const std::array<bool, 6>& is_second, double jitter = 0) {
  auto mesh = dovetail_test::jittered_cubes(6, jitter);
  mesh.tags.assign(mesh.elements.size(), 0);
  std::vector<local_id> parts;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) // six elements in a cell
    parts.push_back(is_second[e / 6 % 6] ? 1 : 0);
  const auto cut = testing::distribute(mesh, parts, [](const auto&) { return host{3, 0}; });
  const io::sides_by_subdomain<3> sides(cut);
  quality_at_interfaces found;
  for (std::size_t p = 0; p < cut.counts.size(); ++p) {
    const auto s = static_cast<local_id>(p);
    const auto piece = cut.load(s);
    const auto rings = measure_at_interfaces(piece, cut.skeleton, sides[s]);
    found.merge(rings);

    const auto boundary = boundary_of_subdomain(cut.skeleton, sort_by_subdomain(cut.skeleton, 2), s);
    std::vector<std::uint8_t> on_interface;
    for (const local_id number : piece.skeleton_points)
      for (std::size_t v = 0; v < boundary.skeleton_points.size(); ++v)
        if (boundary.skeleton_points[v] == number)
          on_interface.push_back(boundary.on_interface[v]);
    CHECK(on_interface.size() == piece.skeleton_points.size());
    const auto at_once = measure_piece(piece.mesh, on_interface);
    CHECK(encoded(*at_once.at_interfaces) == encoded(rings));
    CHECK(encoded(at_once.all) == encoded(measure_quality(piece.mesh)));
  }
  const auto whole = measure_quality(mesh);
  CHECK(found.touching.elements + found.next_ring.elements + found.rest.elements == whole.elements);
  CHECK(std::min({found.touching.min_dihedral_deg, found.next_ring.min_dihedral_deg,
                  found.rest.min_dihedral_deg}) == whole.min_dihedral_deg);
  for (const int degrees : {12, 24, 45, 90})
    CHECK(found.touching.min_dihedrals.below(degrees) + found.next_ring.min_dihedrals.below(degrees) +
              found.rest.min_dihedrals.below(degrees) ==
          whole.min_dihedrals.below(degrees));
  return found;
}

constexpr std::int64_t layer = 6 * 6 * 6; ///< all elements of Kuhn's subdivision touch both of its sides

} // namespace

TEST_CASE("rings of tetrahedra beside an interface, and all of them together") {
  const auto found = of_layers({false, false, false, true, true, true});
  CHECK(found.touching.elements == 2 * layer);
  CHECK(found.next_ring.elements == 2 * layer);
  CHECK(found.rest.elements == 2 * layer);
  CHECK(found.touching.mean_min_dihedral_deg() == doctest::Approx(45));

  const auto at_the_end = of_layers({false, false, false, false, false, true}, 0.15);
  CHECK(at_the_end.touching.elements == 2 * layer);
  CHECK(at_the_end.next_ring.elements == layer);
  CHECK(at_the_end.rest.elements == 3 * layer);

  const auto in_slices = of_layers({false, true, false, true, false, true});
  CHECK(in_slices.touching.elements == 6 * layer);
}

TEST_CASE("without interfaces all elements are the rest") {
  const auto found = of_layers({});
  CHECK(found.touching.elements == 0);
  CHECK(found.touching.mean_min_dihedral_deg() == 0);
  CHECK(found.next_ring.elements == 0);
  CHECK(found.rest.elements == 6 * layer);
}

TEST_CASE("rings of triangles: a line on a curve within a piece is no interface, one between pieces is") {
  // Cells of these widths and height 1, each of two triangles; the interface is at their left end.
  constexpr std::array widths{1.0, 0.5, 0.25, 0.125};
  simplicial_piece<2> piece;
  piece.subdomain = 0;
  simplicial_skeleton<2> skeleton;
  double x = 0;
  for (local_id k = 0; k <= 4; ++k) {
    for (const double y : {0.0, 1.0}) {
      piece.skeleton_points.push_back(static_cast<local_id>(piece.mesh.points.size()));
      piece.mesh.points.push_back({x, y, 0});
    }
    if (k == 4)
      break;
    const local_id v = 2 * k;
    piece.mesh.elements.push_back({v, v + 2, v + 3});
    piece.mesh.elements.push_back({v, v + 3, v + 1});
    x += widths[static_cast<std::size_t>(k)];
  }
  skeleton.points = piece.mesh.points;
  skeleton.sides = std::vector<simplex<1>>{{0, 1}, {8, 9}, {6, 7}};
  skeleton.subdomains = std::vector<std::array<local_id, 2>>{{1, 0}, {0, no_id}, {0, 0}};
  const auto found = measure_at_interfaces(piece, skeleton, std::vector<local_id>{0, 1, 2, 2});
  const auto least_of = [](double width) { return std::atan(width) * 180 / std::acos(-1.0); };
  CHECK(found.touching.elements == 2);
  CHECK(found.touching.min_dihedral_deg == doctest::Approx(least_of(1)));
  CHECK(found.next_ring.elements == 2);
  CHECK(found.next_ring.min_dihedral_deg == doctest::Approx(least_of(0.5)));
  CHECK(found.next_ring.min_dihedrals.below(30) == 2);
  CHECK(found.rest.elements == 4);
  CHECK(found.rest.min_dihedral_deg == doctest::Approx(least_of(0.125)));
  CHECK(found.rest.mean_min_dihedral_deg() == doctest::Approx((least_of(0.25) + least_of(0.125)) / 2));
}

TEST_CASE("rings pass between processes") {
  const auto found = of_layers({false, false, true, true, false, false}, 0.15);
  CHECK(encoded(decoded<quality_at_interfaces>(encoded(found))) == encoded(found));
}
