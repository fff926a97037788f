#include "dovetail/background/tubes.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <doctest/doctest.h>
#include <gp_Ax2.hxx>

#include <numbers>

using namespace dovetail;

namespace {

/// A cube of length 2 with a hole of so small a radius through its middle, along z.
occt_model drilled_cube(double radius) {
  const gp_Ax2 along(gp_Pnt(1, 1, -1), gp_Dir(0, 0, 1));
  return occt_shape_from(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(2, 2, 2).Shape(),
                                         BRepPrimAPI_MakeCylinder(along, radius, 4.0).Shape())
                             .Shape())
      .model;
}

any_sizing finer(const any_geometry& model, double size) {
  return background::finer_at_tubes(uniform_size(size),
                                    background::sizes_at_tubes(model, uniform_size(size)));
}

} // namespace

TEST_CASE("a hole far narrower than the size has good triangles") {
  for (const double size : {0.5, 1.0}) {
    CAPTURE(size);
    const auto made = generate<2>(drilled_cube(0.01), uniform_size(size), parameters<>{});
    REQUIRE(made.failures.empty());
    CHECK(made.quality.min_dihedral_deg > 20);
  }
}

TEST_CASE("there are no bad tetrahedra at a hole far narrower than the size") {
  const auto made = generate<3>(drilled_cube(0.02), uniform_size(1), parameters<>{});
  REQUIRE(made.failures.empty());
  CHECK(made.quality.min_dihedrals.below(12) == 0);
}

TEST_CASE("sizes are small along a hole far narrower than they are, and grow away from it") {
  const any_geometry model(drilled_cube(0.01));
  const any_sizing size = finer(model, 0.5);
  for (const double z : {0.0, 0.3, 1.0, 1.7})
    CHECK(size({1.01, 1, z}) < 0.02);
  CHECK(size({1.2, 1, 1}) > 0.05);
  CHECK(size({0, 0, 0}) == doctest::Approx(0.43).epsilon(0.05));
}

TEST_CASE("sizes stay as they are where a hole is wide enough, and where a face only bends") {
  const any_geometry wide(drilled_cube(0.2));
  CHECK(background::sizes_at_tubes(wide, uniform_size(0.5)).empty());
  // The rounded rim of a disc closes to a ring, but not around what is narrow.
  const any_geometry disc(
      occt_shape_from(BRepPrimAPI_MakeTorus(5, 0.1, 0, std::numbers::pi / 2).Shape()).model);
  for (const size_ball& ball : background::sizes_at_tubes(disc, uniform_size(1)))
    CHECK(ball.size > 1);
}

TEST_CASE("sizes become smaller towards the tip of a cone, but not ever smaller") {
  const any_geometry cone(occt_shape_from(BRepPrimAPI_MakeCone(1, 0, 10).Shape()).model);
  const any_sizing size = finer(cone, 3);
  CHECK(size({0.4, 0, 6}) < 0.6);
  CHECK(size({0, 0, 10}) > 0.2);
}
