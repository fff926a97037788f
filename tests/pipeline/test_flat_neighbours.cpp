#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/remesh/flat_neighbours.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "pipeline/solid_meshes.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace dovetail;
using std::numbers::pi;

namespace {

/// A cone that a plane through its axis halves: a curved face, and a flat one with both of its edges to the
/// tip.
occt_model cone_cut_in_half() {
  return occt_shape_from(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCone(0.2, 0.0, 1.0).Shape(),
                                         BRepPrimAPI_MakeBox(gp_Pnt(-2, -2, -1), 4, 2, 3).Shape())
                             .Shape())
      .model;
}

/// A solid of half a turn, whose flat side is two faces in one plane.
occt_model half_a_turn() {
  return occt_shape_from(BRepPrimAPI_MakeCone(0.4, 0.0, 1.0, pi).Shape()).model;
}

void require_good(const occt_model& model, double size, double volume) {
  CAPTURE(size);
  const auto made = generate<3>(model, uniform_size(size));
  REQUIRE(made.failures.empty());
  CHECK(io::check_distributed(made.mesh).valid());
  CHECK(made.quality.min_dihedral_deg > 12);
  CHECK(testing::volume_of(made.mesh) == doctest::Approx(volume).epsilon(0.08));
}

} // namespace

TEST_CASE("the tip of half a cone has no triangle in the flat side") {
  for (const double size : {0.2, 0.15, 0.1, 0.07})
    require_good(cone_cut_in_half(), size, pi * 0.04 / 6);
  for (const double size : {0.2, 0.1, 0.07})
    require_good(half_a_turn(), size, pi * 0.16 / 6);
}

TEST_CASE("nor has it when the surface is meshed alone, in one piece or in several") {
  for (const double size : {0.1, 0.05, 0.02}) {
    CAPTURE(size);
    for (const int pieces : {1, 4}) {
      const auto made = generate<2>(cone_cut_in_half(), uniform_size(size),
                                    parameters<>{}.with_options({.subdomains = pieces}));
      REQUIRE(made.failures.empty());
      CHECK(io::check_distributed(made.mesh).valid());
      CHECK(made.quality.min_dihedral_deg > 6);
    }
  }
}

TEST_CASE("points share a plane on one flat face, or on two in one plane, and on no curved one") {
  const any_geometry model(half_a_turn());
  std::vector<local_id> flat, curved;
  for (std::size_t f = 0; f < model.topology().faces.size(); ++f)
    (model.plane_of_face(static_cast<local_id>(f)) ? flat : curved).push_back(static_cast<local_id>(f));
  REQUIRE(flat.size() == 3); // the base, and two beside the axis
  REQUIRE(curved.size() == 1);
  detail::flat_neighbours neighbours(model, {10, 11, 12, 13, 14});
  CHECK(neighbours.is_flat(flat[0]));
  CHECK(!neighbours.is_flat(curved[0]));
  for (std::size_t k = 0; k < 3; ++k) // point 10 + k is on flat face k, 13 is on all of them
    neighbours.add(flat[k], std::array<local_id, 3>{static_cast<local_id>(10 + k), 13, 20});
  neighbours.add(curved[0], std::array<local_id, 2>{13, 14});
  int coplanar = 0;
  for (const auto& [p, q] : {std::array<local_id, 2>{10, 11}, {11, 12}, {10, 12}})
    coplanar += neighbours.share_a_plane(p, q) ? 1 : 0;
  CHECK(coplanar == 1);
  CHECK(neighbours.share_a_plane(10, 13));
  CHECK(neighbours.share_a_plane(13, 12));
  CHECK(!neighbours.share_a_plane(13, 14));
  CHECK(!neighbours.share_a_plane(10, 20)); // nobody said that 20 would be asked for
}
