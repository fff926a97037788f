#include "dovetail/models/occt/imprint.hpp"
#include "dovetail/models/occt/joined_triangulation.hpp"
#include "dovetail/models/occt/topology.hpp"
#include "dovetail/models/shared_contacts.hpp"

#include <BOPAlgo_Builder.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <doctest/doctest.h>
#include <gp_Pln.hxx>

#include <cmath>
#include <limits>
#include <vector>

using namespace dovetail;

namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

TopoDS_Shape box(double x, double y, double z, double a, double b, double c) {
  return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), a, b, c).Shape();
}

/// Shapes beside each other, as they are.
occt::brep beside(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes)
    builder.Add(all, shape);
  return occt::brep_builder(all, {}).build();
}

/// The same with all contacts shared.
occt::brep fused(const std::vector<TopoDS_Shape>& shapes) {
  BOPAlgo_Builder fuse;
  for (const TopoDS_Shape& shape : shapes)
    fuse.AddArgument(shape);
  fuse.Perform();
  return occt::brep_builder(fuse.Shape(), {}).build();
}

double unshared(const occt::brep& data, double within, double deflection = 1e-3) {
  return unshared_distance(occt::joined_triangulation(data, deflection, 0.35), data.topology, within);
}
bool one_inside(const occt::brep& data) {
  return has_body_inside_another(occt::joined_triangulation(data, 1e-3, 0.35), data.topology);
}

/// Two flat solids at the edge from the first to the second point, which include an angle between them.
double unshared_at_angle(double degrees) {
  const double angle = degrees * std::acos(-1.0) / 180;
  surface_mesh surface;
  surface.mesh.points = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {std::cos(angle), 0.5, std::sin(angle)}};
  surface.mesh.elements = {{0, 1, 2}, {0, 1, 3}};
  surface.mesh.tags = {0, 1};
  geometry_topology topology;
  topology.solids.resize(2);
  topology.faces.resize(2);
  topology.faces[0].solids = {0, no_id};
  topology.faces[1].solids = {1, no_id};
  return unshared_distance(surface, topology, 0.1);
}

} // namespace

TEST_CASE("bodies that share what they have in common are nowhere near each other") {
  CHECK(unshared(fused({box(0, 0, 0, 1, 1, 1), box(1, 0, 0, 1, 1, 1)}), 0.1) == nowhere);
  CHECK(unshared(fused({box(0, 0, 0, 1, 1, 1), box(1, 0.3, 0.3, 1, 2, 0.4)}), 0.05) == nowhere);
  CHECK(unshared(fused({box(0, 0, 0, 1, 1, 1), box(1, 1, 0, 1, 1, 1)}), 0.1) == nowhere); // an edge
  CHECK(unshared(fused({box(0, 0, 0, 2, 2, 2), BRepPrimAPI_MakeSphere(gp_Pnt(1, 1, 1), 0.5).Shape()}), 0.1) ==
        nowhere);
}

TEST_CASE("bodies that touch, cross or overlap are at distance 0") {
  CHECK(unshared(beside({box(0, 0, 0, 1, 1, 1), box(1, 0, 0, 1, 1, 1)}), 0.1) == 0);
  CHECK(unshared(beside({box(0, 0, 0, 1, 1, 1), box(1, 0.3, 0.3, 1, 2, 0.4)}), 0.1) == 0);
  CHECK(unshared(beside({box(0, 0, 0, 1, 1, 1), box(1, 1, 0, 1, 1, 1)}), 0.1) == 0);
  CHECK(unshared(beside({box(0, 0, 0, 1, 1, 1), box(0.5, 0.4, 0.3, 1, 1, 1)}), 0.1) == 0);
  const TopoDS_Shape plane =
      BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0.5, 0.5, 0.5), gp_Dir(0, 0, 1)), -2, 2, -2, 2).Shape();
  CHECK(unshared(beside({box(0, 0, 0, 1, 1, 1), plane}), 0.1) == 0);
}

TEST_CASE("the distance of bodies that are near each other is that of their triangles") {
  const auto near = beside({box(0, 0, 0, 1, 1, 1), box(1.01, 0.2, 0.1, 1, 1, 1)});
  CHECK(unshared(near, 0.1) == doctest::Approx(0.01));
  CHECK(unshared(near, 0.005) == nowhere);
  // Of two rods the finer triangles are farther apart, and closer to the surfaces.
  const auto rods =
      beside({BRepPrimAPI_MakeCylinder(1.0, 4.0).Shape(),
              BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-2, 0, 5.1), gp_Dir(1, 0, 0)), 1.0, 4.0).Shape()});
  CHECK(unshared(rods, 0.5) == doctest::Approx(0.1).epsilon(0.1));
}

TEST_CASE("faces in no solid are compared with solids, and not with each other") {
  const auto plane = [](double z) {
    return BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0.5, 0.5, z), gp_Dir(0, 0, 1)), -0.2, 0.2, -0.2, 0.2)
        .Shape();
  };
  CHECK(unshared(beside({plane(1.5), plane(1.501)}), 0.1) == nowhere);
  CHECK(unshared(beside({box(0, 0, 0, 1, 1, 1), plane(1.05)}), 0.1) == doctest::Approx(0.05));
  CHECK(one_inside(beside({box(0, 0, 0, 1, 1, 1), plane(0.5)})));
  CHECK(!one_inside(beside({box(0, 0, 0, 1, 1, 1), plane(1.5)})));
}

TEST_CASE("a body inside another is found, one that fills its void is not inside") {
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(gp_Pnt(1, 1, 1), 0.5).Shape();
  const auto inside = beside({box(0, 0, 0, 2, 2, 2), ball});
  CHECK(unshared(inside, 0.1) == nowhere);
  CHECK(one_inside(inside));
  CHECK(one_inside(beside({ball, box(0, 0, 0, 2, 2, 2)})));
  CHECK(!one_inside(fused({box(0, 0, 0, 2, 2, 2), ball})));
  CHECK(!one_inside(fused({box(0, 0, 0, 1, 1, 1), box(1, 0, 0, 1, 1, 1)})));
  CHECK(!one_inside(beside({box(0, 0, 0, 1, 1, 1), box(3, 0, 0, 1, 1, 1)})));
  // In a frame's box, and not in the frame.
  const auto frame = fused({box(0, 0, 0, 4, 1, 1), box(0, 1, 0, 1, 2, 1), box(3, 1, 0, 1, 2, 1),
                            box(0, 3, 0, 4, 1, 1), box(1.5, 1.5, 0.2, 1, 1, 0.5)});
  CHECK(!one_inside(frame));
}

TEST_CASE("triangles at a common edge that include a small angle may belong to faces that touch") {
  CHECK(unshared_at_angle(8) == 0);
  CHECK(unshared_at_angle(-8) == 0);
  CHECK(unshared_at_angle(15) == nowhere);
  CHECK(unshared_at_angle(180) == nowhere);
}

TEST_CASE("who shares all contacts is not intersected: near faces are looked at with finer triangles") {
  CHECK(occt::shares_all_contacts(fused({box(0, 0, 0, 1, 1, 1), box(1, 0, 0, 1, 1, 1)})));
  CHECK(!occt::shares_all_contacts(beside({box(0, 0, 0, 1, 1, 1), box(1, 0, 0, 1, 1, 1)})));
  CHECK(!occt::shares_all_contacts(
      beside({box(0, 0, 0, 2, 2, 2), BRepPrimAPI_MakeSphere(gp_Pnt(1, 1, 1), 0.5).Shape()})));
  // A rod beside a ball, with a gap that only the finer triangles tell from a contact.
  const auto rod_beside_ball = [](double gap) {
    const TopoDS_Shape rod = BRepPrimAPI_MakeCylinder(1 - gap, 1.0).Shape();
    const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(gp_Pnt(3, 0, 0.5), 2.0).Shape();
    return beside({rod, ball});
  };
  CHECK(occt::shares_all_contacts(rod_beside_ball(3e-3)));
  CHECK(!occt::shares_all_contacts(rod_beside_ball(0)));
}
