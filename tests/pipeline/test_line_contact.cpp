#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "pipeline/solid_meshes.hpp"

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <doctest/doctest.h>
#include <gp_Ax2.hxx>

#include <cmath>
#include <cstddef>
#include <numbers>

using namespace dovetail;

namespace {

/// A roller that lies on a plate, and touches it along a line.
occt_model roller_on_plate() {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(1, 1, 0.3).Shape());
  builder.Add(both,
              BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0.3, 0.5, 0.5), gp_Dir(1, 0, 0)), 0.2, 0.4).Shape());
  return occt_shape_from(both).model;
}

/// The skeleton's points that both solids have, all of which are on the line of contact.
std::size_t points_in_contact(const distributed_mesh& mesh) {
  std::size_t count = 0;
  for (const vec3 p : mesh.skeleton.points)
    if (std::abs(p.z - 0.3) < 1e-9 && std::abs(p.y - 0.5) < 1e-9 && p.x > 0.3 - 1e-9 && p.x < 0.7 + 1e-9)
      ++count;
  return count;
}

} // namespace

TEST_CASE("a roller on a plate is meshed, and both have the points of the line in which they touch") {
  for (const int parts : {1, 4}) {
    CAPTURE(parts);
    const auto made =
        generate<3>(roller_on_plate(), uniform_size(0.1), parameters<>{}.with_options({.subdomains = parts}));
    REQUIRE(made.failures.empty());
    CHECK(io::check_distributed(made.mesh).valid());
    CHECK(made.quality.min_dihedral_deg > 12);
    const double roller = std::numbers::pi * 0.04 * 0.4;
    CHECK(testing::volume_of(made.mesh) == doctest::Approx(0.3 + roller).epsilon(0.02));
    CHECK(points_in_contact(made.mesh) >= 4);
  }
}

TEST_CASE("so is its surface alone") {
  for (const int parts : {1, 4}) {
    CAPTURE(parts);
    const auto made =
        generate<2>(roller_on_plate(), uniform_size(0.1), parameters<>{}.with_options({.subdomains = parts}));
    REQUIRE(made.failures.empty());
    CHECK(io::check_distributed(made.mesh).valid());
    CHECK(made.quality.min_dihedral_deg > 12);
  }
}
