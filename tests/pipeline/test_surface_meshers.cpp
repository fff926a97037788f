#include "dovetail/adapters/cgal_surface.hpp"
#include "dovetail/adapters/gmsh_surface.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "solid_meshes.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

using namespace dovetail;

namespace {

/// A block with a hole, whose face is passed twice at its seam, and a dent, whose face has a pole.
TopoDS_Shape drilled_and_dented() {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(2, 1.5, 1)).Shape();
  const gp_Ax2 axis(gp_Pnt(0.5, 0.7, -1), gp_Dir(0, 0, 1));
  const TopoDS_Shape drilled = BRepAlgoAPI_Cut(block, BRepPrimAPI_MakeCylinder(axis, 0.3, 3).Shape()).Shape();
  return BRepAlgoAPI_Cut(drilled, BRepPrimAPI_MakeSphere(gp_Pnt(1.4, 0.8, 1), 0.35).Shape()).Shape();
}

generated<3> mesh_by(const any_surface_mesher& mesher) {
  return generate<3>(occt_shape_from(drilled_and_dented()).model, uniform_size(0.12),
                     parameters<>{}
                         .with_mesher(mesher::tetgen{})
                         .with_surface_mesher(mesher)
                         .with_options({.subdomains = 4}));
}

/// Leaves out a triangle where x is 0.
struct leaves_a_hole {
  patch_mesh operator()(const any_surface& s, const patch_boundary& b, const any_sizing& size) const {
    patch_mesh made = remesh::patch_remesher{}(s, b, size);
    const bool at_zero = std::all_of(b.points.begin(), b.points.end(), [](vec3 p) { return p.x == 0; });
    if (at_zero && made.triangles.size() > 20)
      made.triangles.erase(made.triangles.begin() + 10);
    return made;
  }
};

} // namespace

TEST_CASE("tetrahedra inside a surface by every surface mesher: a valid mesh, which is its own") {
  const double expected = 2 * 1.5 * 1 - std::numbers::pi * (0.3 * 0.3 + 2.0 / 3 * 0.35 * 0.35 * 0.35);
  const auto native = mesh_by({});
  for (const any_surface_mesher& mesher :
       {any_surface_mesher(), any_surface_mesher(mesher::cgal_delaunay{}, "cgal"),
        any_surface_mesher(mesher::gmsh_frontal{}, "gmsh")}) {
    CAPTURE(mesher.name());
    const auto result = mesh_by(mesher);
    CHECK(result.failures.empty());
    CHECK(io::check_distributed(result.mesh).valid());
    CHECK(testing::volume_of(result.mesh) == doctest::Approx(expected).epsilon(5e-3));
    CHECK((io::mesh_hash(result.mesh) == io::mesh_hash(native.mesh)) == (mesher.name() == "native"));
    CHECK(io::mesh_hash(result.mesh) == io::mesh_hash(mesh_by(mesher).mesh));
  }
}

TEST_CASE("a surface mesher whose result is not what it should be is found out, and the face named") {
  CHECK_THROWS_WITH_AS(mesh_by(leaves_a_hole{}), doctest::Contains("face 0: "), mesher_error);
}
