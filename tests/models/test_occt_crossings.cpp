#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/models/occt/brep.hpp"
#include "dovetail/models/occt/shape.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "models/model_checks.hpp"
#include "models/triangulation_checks.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_Line.hxx>
#include <TopoDS_Wire.hxx>
#include <doctest/doctest.h>

#include <algorithm>
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

/// The reading reports `note`, and what was read has a surface.
void check_healed(const occt_read_result& read, const std::string& note) {
  CHECK(testing::joined(testing::faults_of(read.model)) == "");
  CHECK(read.model.data().crossing.empty());
  const auto& warnings = read.report.warnings;
  CHECK_MESSAGE(std::find(warnings.begin(), warnings.end(), note) != warnings.end(),
                testing::joined(warnings));
  CHECK_NOTHROW(background::coarse_surface(read.model, uniform_size(1), {}, parallel::serial{}));
}

} // namespace

TEST_CASE("a small edge that is no pole is left out, with a note that names the face") {
  const occt_read_result read = occt_shape_from(box_with_small_edge(5e-4, 5e-4));
  check_healed(read, "face 0: small edges that are no poles were left out");
  CHECK(read.model.topology().faces[0].coedges.size() == 4);
}

TEST_CASE("so is one that is short enough for a pole, where the boundary runs back along it") {
  check_healed(occt_shape_from(box_with_small_edge(2e-6, 3e-6)),
               "face 0: its boundary crossed itself in the parameter plane; small edges that are no poles "
               "were left out");
}

TEST_CASE("a boundary that runs back along an edge of some length is repaired by OCCT, on that face alone") {
  check_healed(occt_shape_from(box_with_small_edge(1e-2, 1.5e-2)),
               "repaired by fixing single faces, for face 0, whose boundary crosses itself in the parameter "
               "plane");
}
