/// Solids that touch themselves at a vertex where two of their edges begin along each other: the gap between
/// these begins where the mesh can show it. Angles are in degrees.
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "models/virtual_shapes.hpp"
#include "pipeline/solid_meshes.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopoDS_Shape.hxx>
#include <doctest/doctest.h>
#include <gp_Ax2.hxx>

#include <algorithm>
#include <cmath>
#include <cstddef>

using namespace dovetail;
using namespace dovetail::testing;
using kind = suppressed_detail::kind;

namespace {

constexpr double size_at_gaps = 2;

/// A block under a hollow of radius 10, whose lowest line is in the plane of the bottom of a block behind it.
/// The blocks meet where the hollow is higher: on both sides of (5, 0, 5), in gaps that are narrow there.
TopoDS_Shape hollow_and_block() {
  const TopoDS_Shape roll = BRepPrimAPI_MakeCylinder(gp_Ax2({5, -6, 15}, {0, 1, 0}), 10, 12).Shape();
  const TopoDS_Shape lower =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox({0, -5, 0}, {10, 0, 8}).Shape(), roll).Shape();
  return BRepAlgoAPI_Fuse(lower, BRepPrimAPI_MakeBox({0, 0, 5}, {10, 5, 10}).Shape()).Shape();
}

/// What a box has around such a solid.
TopoDS_Shape box_without(const TopoDS_Shape& shape) {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox({-5, -10, -5}, {15, 10, 15}).Shape(), shape).Shape();
}

any_geometry cad_model(const TopoDS_Shape& shape) {
  return occt_shape_from(shape).model;
}

std::ptrdiff_t gaps_of(const virtual_model& model) {
  const auto& all = model.suppressed();
  return std::count_if(all.begin(), all.end(), [](const auto& one) { return one.what == kind::narrow_gap; });
}

/// Of a mesh in which the improver leaves edges as long as usual.
double least_angle_of(const any_geometry& model, double volume) {
  const auto made = generate<3>(
      model, uniform_size(size_at_gaps),
      parameters<>{}.with_mesher(mesher::tetgen{}).with_improver(improvement::native{.bad_angle = 0}));
  REQUIRE(made.failures.empty());
  CHECK(io::check_distributed(made.mesh).valid());
  CHECK(volume_of(made.mesh) == doctest::Approx(volume).epsilon(0.02));
  return made.quality.min_dihedral_deg;
}

} // namespace

TEST_CASE("a gap between two edges that begin along each other begins where it is wide enough") {
  const any_geometry given = cad_model(hollow_and_block());
  const virtual_model made(given, uniform_size(size_at_gaps), {.share_of_joined = 0});
  CHECK(virtual_checks(made, given, 0.25 * size_at_gaps).faults() == "");
  CHECK(gaps_of(made) == 2);
  CHECK(made.summary().get("narrow_gaps") == 2);
  const auto passages = passages_of_curves(made.topology());
  CHECK(std::count(passages.begin(), passages.end(), 4) == 2);
  for (const suppressed_detail& one : made.suppressed()) {
    CHECK(one.length > 0.1 * size_at_gaps);
    CHECK(std::abs(one.place.y) < 1e-6);
    CHECK(std::abs(one.place.z - 5) < 0.25 * size_at_gaps);
  }
  CHECK(gaps_of(virtual_model(made, uniform_size(size_at_gaps))) == 0);
}

TEST_CASE("a gap outside of the solid stays, and so do all at no share of the size") {
  const any_sizing sizes = uniform_size(size_at_gaps);
  CHECK(gaps_of(virtual_model(cad_model(box_without(hollow_and_block())), sizes)) == 0);
  CHECK(gaps_of(virtual_model(cad_model(hollow_and_block()), sizes, {.share_of_size = 0})) == 0);
}

TEST_CASE("no element is thin for a gap that begins at a point") {
  const any_geometry given = cad_model(hollow_and_block());
  const double below = 54.34; // the hollow, in a cut through it
  const double volume = 5 * below + 10 * 5 * 5;
  CHECK(least_angle_of(virtual_model(given, uniform_size(size_at_gaps)), volume) > 12);
  CHECK(least_angle_of(given, volume) < 12);
}
