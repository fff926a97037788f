#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/models/occt/brep.hpp"
#include "dovetail/models/occt/shape.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "models/model_checks.hpp"
#include "models/triangulation_checks.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_Circle.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Wire.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <string>

using namespace dovetail;

namespace {

/// A box of 10 x 8 x 2 whose first face has an edge that is no pole and yet has no curve in space: it begins
/// `back` before the corner that it belongs to and ends `beyond` it.
TopoDS_Shape box_with_small_edge(double back, double beyond) {
  const BRep_Builder builder;
  const TopoDS_Shape box = BRepBuilderAPI_Copy(BRepPrimAPI_MakeBox(10, 8, 2).Shape()).Shape();
  TopoDS_Face face = TopoDS::Face(occt::sub_shapes(box, TopAbs_FACE)(1).Oriented(TopAbs_FORWARD));
  const TopoDS_Shape wire = occt::sub_shapes(face, TopAbs_WIRE)(1);
  TopoDS_Wire with_edge;
  builder.MakeWire(with_edge);
  for (TopExp_Explorer edges(wire, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
    const bool first = with_edge.NbChildren() == 0;
    builder.Add(with_edge, edge);
    if (!first)
      continue;
    double from = 0, to = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, from, to);
    const bool reversed = edge.Orientation() == TopAbs_REVERSED;
    gp_Pnt2d corner;
    gp_Vec2d along;
    curve->D1(reversed ? from : to, corner, along);
    const gp_Dir2d direction(reversed ? along.Reversed() : along);
    const TopoDS_Vertex vertex = TopExp::LastVertex(edge, true);
    builder.UpdateVertex(vertex, 20 * (back + beyond));
    TopoDS_Edge small;
    builder.MakeEdge(small);
    builder.UpdateEdge(small, new Geom2d_Line(corner.Translated(-back * gp_Vec2d(direction)), direction),
                       face, 1e-7);
    builder.Add(small, vertex.Oriented(TopAbs_FORWARD));
    builder.Add(small, vertex.Oriented(TopAbs_REVERSED));
    builder.Range(small, 0, back + beyond);
    builder.Degenerated(small, true);
    builder.Add(with_edge, small);
  }
  face.Free(true);
  builder.Remove(face, wire);
  builder.Add(face, with_edge);
  return box;
}

/// A cylinder whose round face goes around twice in its parameter plane: edges that are called poles, and are
/// none, join its two circles to seams four pi apart.
TopoDS_Shape cylinder_with_false_poles() {
  constexpr double turn = 2 * std::numbers::pi;
  const BRep_Builder builder;
  const Handle(Geom_Surface) surface = new Geom_CylindricalSurface(gp_Ax3(), 1);
  TopoDS_Face side;
  builder.MakeFace(side, surface, 1e-7);
  std::array<TopoDS_Vertex, 2> vertices;
  std::array<TopoDS_Edge, 2> circles, poles;
  TopoDS_Edge seam;
  const auto straight = [](double u, double v, gp_Dir2d way) { return new Geom2d_Line(gp_Pnt2d(u, v), way); };
  const auto add_ends = [&](TopoDS_Edge& edge, std::size_t first, std::size_t last, double length) {
    builder.Add(edge, vertices[first].Oriented(TopAbs_FORWARD));
    builder.Add(edge, vertices[last].Oriented(TopAbs_REVERSED));
    builder.Range(edge, 0, length);
  };
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const double z = k == 0 ? 0 : 1;
    builder.MakeVertex(vertices[k], gp_Pnt(1, 0, z), 1e-7);
    builder.MakeEdge(circles[k], new Geom_Circle(gp_Ax2(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1)), 1), 1e-7);
    builder.UpdateEdge(circles[k], straight(k == 0 ? 0 : -turn, z, {1, 0}), side, 1e-7);
    builder.MakeEdge(poles[k]);
    builder.UpdateEdge(poles[k], straight(k == 0 ? -turn : turn, z, {k == 0 ? 1.0 : -1.0, 0}), side, 1e-7);
    add_ends(circles[k], k, k, turn);
    add_ends(poles[k], k, k, turn);
    builder.Degenerated(poles[k], true);
  }
  builder.MakeEdge(seam, new Geom_Line(gp_Pnt(1, 0, 0), gp_Dir(0, 0, 1)), 1e-7);
  builder.UpdateEdge(seam, straight(turn, 0, {0, 1}), straight(-turn, 0, {0, 1}), side, 1e-7);
  add_ends(seam, 0, 1, 1);
  TopoDS_Wire around;
  builder.MakeWire(around);
  for (const TopoDS_Shape& edge : {TopoDS_Shape(poles[1]), circles[1].Reversed(), seam.Reversed(),
                                   TopoDS_Shape(poles[0]), TopoDS_Shape(circles[0]), TopoDS_Shape(seam)})
    builder.Add(around, edge);
  builder.Add(side, around);
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  builder.Add(shell, side);
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    TopoDS_Wire rim;
    builder.MakeWire(rim);
    builder.Add(rim, circles[k]);
    const gp_Pln plane(gp_Pnt(0, 0, k == 0 ? 0 : 1), gp_Dir(0, 0, 1));
    const TopoDS_Shape lid = BRepBuilderAPI_MakeFace(plane, rim).Face();
    builder.Add(shell, k == 0 ? lid.Reversed() : lid);
  }
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

/// The reading reports `note`, and what was read has a surface.
void check_healed(const occt_read_result& read, const std::string& note) {
  CHECK(testing::joined(testing::faults_of(read.model)) == "");
  CHECK(read.model.data().crossing.empty());
  const auto& warnings = read.report.warnings;
  CHECK_MESSAGE(std::find(warnings.begin(), warnings.end(), note) != warnings.end(),
                testing::joined(warnings));
  CHECK_NOTHROW(background::coarse_surface(read.model, uniform_size(1), {}, parallel::serial{},
                                           remesh::patch_remesher{}));
}

} // namespace

TEST_CASE("a small edge that is no pole is left out, with a note that names the face") {
  const occt_read_result read = occt_shape_from(box_with_small_edge(5e-4, 5e-4));
  check_healed(read, "face 0: edges without a curve in space that are no poles were left out");
  CHECK(read.model.topology().faces[0].coedges.size() == 4);
}

TEST_CASE("so are edges that are called poles, however far they go") {
  const occt_read_result read = occt_shape_from(cylinder_with_false_poles());
  check_healed(read, "face 0: edges without a curve in space that are no poles were left out");
  CHECK(read.model.topology().faces[0].coedges.size() == 4);
  CHECK_NOTHROW(background::coarse_surface(read.model, uniform_size(0.2), {}, parallel::serial{},
                                           remesh::patch_remesher{}));
}

TEST_CASE("so is one that is short enough for a pole, where the boundary runs back along it") {
  check_healed(occt_shape_from(box_with_small_edge(2e-6, 3e-6)),
               "face 0: its boundary crossed itself in the parameter plane; edges without a curve in space "
               "that are no poles "
               "were left out");
}

TEST_CASE("a boundary that runs back along an edge of some length is repaired by OCCT, on that face alone") {
  check_healed(occt_shape_from(box_with_small_edge(1e-2, 1.5e-2)),
               "repaired by fixing single faces, for face 0, whose boundary crosses itself in the parameter "
               "plane");
}
