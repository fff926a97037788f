/// Solids with tiny details are meshed without them: closed, conforming, and without thin elements. Angles
/// are in degrees.
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/models/occt_model.hpp"
#include "models/virtual_shapes.hpp"
#include "pipeline/plane_meshes.hpp"
#include "pipeline/solid_meshes.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

/// By tetrahedra, for meshes of triangles and of tetrahedra.
double volume_inside(const whole_mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += signed_volume({0, 0, 0}, mesh.points.at(a), mesh.points.at(b), mesh.points.at(c));
  return sum;
}

generate_result mesh_solid(const any_geometry& model, double size, int parts) {
  return generate<3>(model, uniform_size(size),
                     parameters<>{}.with_mesher(mesher::tetgen{}).with_options(in_parts(parts)));
}

/// Meshes of a model with and without its details: only the first ones have thin elements.
void check_meshes(const any_geometry& given, double size, double volume) {
  const virtual_model model(given, uniform_size(size));
  REQUIRE(!model.suppressed().empty());
  for (const int parts : {1, 4}) {
    CAPTURE(parts);
    const auto shell = generate<2>(model, uniform_size(size), parameters<>{}.with_options(in_parts(parts)));
    const whole_mesh surface = require_valid(shell);
    CHECK(euler_characteristic(surface) == 2);
    CHECK(volume_inside(surface) == doctest::Approx(volume).epsilon(0.02));
    CHECK(shell.quality.min_face_deg > 12);
    for (const local_id face : surface.faces)
      CHECK(!model.topology().faces[face].loops.empty());

    const auto solid = mesh_solid(model, size, parts);
    REQUIRE(solid.failures.empty());
    CHECK(io::check_distributed(solid.mesh).valid());
    CHECK(volume_of(solid.mesh) == doctest::Approx(volume).epsilon(0.02));
    CHECK(solid.quality.min_face_deg > 12);
    CHECK(solid.quality.min_dihedral_deg > 12);
  }
  const auto shell = generate<2>(given, uniform_size(size), parameters<>{}.with_options(in_parts(1)));
  CHECK(shell.quality.min_face_deg < 12);
  CHECK(mesh_solid(given, size, 1).quality.min_face_deg < 12);
}

} // namespace

TEST_CASE("a cube with a tiny chamfer, split along it, is meshed as a cube") {
  check_meshes(chamfered_cube(0.1, 0.12, {0, 2.5, 5, 10},
                              [](std::size_t side, std::size_t layer) {
                                return side == 1 ? static_cast<local_id>(layer) : no_id;
                              })
                   .model(),
               1.5, 1000);
}

TEST_CASE("a step in two sides of a cube is no row of thin elements") {
  const outline stepped{{0, 0}, {5, 0}, {5.1, -0.1}, {10, -0.1}, {10, 6}, {10.05, 6.1}, {10.05, 10}, {0, 10}};
  check_meshes(prism(stepped, stepped, {5, 5}, {0, 10}).model(), 1.5, 1000);
}

TEST_CASE("a chamfer that begins at a point begins where the mesh can show it") {
  check_meshes(chamfered_cube(0, 1.5).model(), 1.5, 1000 - 1.5 * 1.5 / 6 * 10);
}

TEST_CASE("a step all around a cylinder is one circle") {
  const TopoDS_Shape lower = BRepPrimAPI_MakeCylinder(3.1, 3).Shape();
  const TopoDS_Shape upper =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 3), gp_Dir(0, 0, 1), gp_Dir(0, 1, 0)), 3, 3).Shape();
  check_meshes(occt_shape_from(BRepAlgoAPI_Fuse(lower, upper).Shape()).model, 1,
               std::numbers::pi * 3 * (3.1 * 3.1 + 3 * 3));
}

TEST_CASE("no element is thin under a slit, straight or around a pin") {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(10, 10, 5).Shape();
  const TopoDS_Shape cut = BRepPrimAPI_MakeBox(gp_Pnt(5, -1, 2), gp_Pnt(5.05, 6, 6)).Shape();
  check_meshes(occt_shape_from(BRepAlgoAPI_Cut(block, cut).Shape()).model, 1, 500 - 0.05 * 6 * 3);
  const TopoDS_Shape hole = BRepPrimAPI_MakeBox(gp_Pnt(3, 3, 2), gp_Pnt(7, 7, 6)).Shape();
  const TopoDS_Shape pin = BRepPrimAPI_MakeBox(gp_Pnt(3.05, 3.05, 2), gp_Pnt(6.95, 6.95, 5)).Shape();
  check_meshes(occt_shape_from(BRepAlgoAPI_Fuse(BRepAlgoAPI_Cut(block, hole).Shape(), pin).Shape()).model, 1,
               500 - (4 * 4 - 3.9 * 3.9) * 3);
}

TEST_CASE("random solids with random details are meshed, closed") {
  for (unsigned seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const discrete_model given = random_solid(random).model();
    const uniform_size size(1 + seed % 3);
    const whole_mesh surface = require_valid(
        generate<2>(virtual_model(given, size), size, parameters<>{}.with_options(in_parts(3))));
    CHECK(euler_characteristic(surface) == 2);
    CHECK(volume_inside(surface) == doctest::Approx(*given.volume()).epsilon(0.05));
  }
}
