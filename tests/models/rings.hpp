/// @file
/// Bars that are bent to a ring, and touch themselves, or nearly do.
#pragma once

#include "dovetail/core/vector.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <Bnd_Box.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include <vector>

namespace dovetail::testing {

/// The prism of height 1 over a polygon.
inline TopoDS_Shape prism(const std::vector<vec2>& outline) {
  BRepBuilderAPI_MakePolygon polygon;
  for (const vec2 p : outline)
    polygon.Add(gp_Pnt(p.x, p.y, 0));
  polygon.Close();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire(), true).Face(), gp_Vec(0, 0, 1)).Shape();
}

/// A bar that ends in a point at `height`: its other end is at 3 to 4.
inline TopoDS_Shape ring_with_tip(double height) {
  return prism({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 3}, {3, 3}, {3, 1}, {1, 1}, {0.5, height}, {0, 1}});
}

/// A ring with a gap; from one of its ends a thorn goes through the other one.
inline TopoDS_Shape ring_through_itself() {
  const TopoDS_Shape arm = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(3, 1, 1).Shape(),
                                            BRepPrimAPI_MakeBox(gp_Pnt(0.2, 0.5, 0.3), 0.4, 4, 0.4).Shape())
                               .Shape();
  const TopoDS_Shape rest = prism({{3, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 3}, {3, 3}, {3, 1}});
  BRepBuilderAPI_Sewing sewing;
  for (const TopoDS_Shape& part : {arm, rest})
    for (TopExp_Explorer faces(part, TopAbs_FACE); faces.More(); faces.Next()) {
      Bnd_Box box;
      BRepBndLib::Add(faces.Current(), box);
      const bool is_between =
          box.CornerMin().X() > 2.9 && box.CornerMax().X() < 3.1 && box.CornerMax().Y() < 1.1;
      if (!is_between)
        sewing.Add(faces.Current());
    }
  sewing.Perform();
  return BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape())).Solid();
}

/// A block with a pin that stands in a hole of it, so much narrower.
inline TopoDS_Shape pin_in_hole(double clearance) {
  const gp_Ax2 axis(gp_Pnt(1.5, 1.5, 1), gp_Dir(0, 0, 1));
  const TopoDS_Shape block =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(3, 3, 2).Shape(), BRepPrimAPI_MakeCylinder(axis, 1, 1).Shape())
          .Shape();
  return BRepAlgoAPI_Fuse(block, BRepPrimAPI_MakeCylinder(axis, 1 - clearance, 1).Shape()).Shape();
}

/// A block with a bar whose upper side is so far below the block's: the opening in the block's face that the
/// bar stands in reaches its outer boundary, or nearly does. With edges of their own both.
inline TopoDS_Shape block_with_flush_bar(double below) {
  const auto wire = [](const std::vector<vec3>& corners) {
    BRepBuilderAPI_MakePolygon polygon;
    for (const vec3 p : corners)
      polygon.Add(gp_Pnt(p.x, p.y, p.z));
    polygon.Close();
    return polygon.Wire();
  };
  const double top = 1 - below;
  BRepBuilderAPI_Sewing sewing(1e-9, true, true, false); // nothing is cut
  BRepBuilderAPI_MakeFace front(wire({{0, 3, 0}, {0, 3, 1}, {3, 3, 1}, {3, 3, 0}}), true);
  front.Add(wire({{1, 3, 0.4}, {2, 3, 0.4}, {2, 3, top}, {1, 3, top}}));
  sewing.Add(front.Face());
  for (const std::vector<vec3>& corners :
       std::vector<std::vector<vec3>>{{{0, 0, 0}, {0, 3, 0}, {3, 3, 0}, {3, 0, 0}}, // of the block
                                      {{0, 0, 1}, {3, 0, 1}, {3, 3, 1}, {0, 3, 1}},
                                      {{0, 0, 0}, {3, 0, 0}, {3, 0, 1}, {0, 0, 1}},
                                      {{0, 0, 0}, {0, 0, 1}, {0, 3, 1}, {0, 3, 0}},
                                      {{3, 0, 0}, {3, 3, 0}, {3, 3, 1}, {3, 0, 1}},
                                      {{1, 3, 0.4}, {1, 5, 0.4}, {2, 5, 0.4}, {2, 3, 0.4}}, // of the bar
                                      {{1, 3, top}, {2, 3, top}, {2, 5, top}, {1, 5, top}},
                                      {{1, 3, 0.4}, {1, 3, top}, {1, 5, top}, {1, 5, 0.4}},
                                      {{2, 3, 0.4}, {2, 5, 0.4}, {2, 5, top}, {2, 3, top}},
                                      {{1, 5, 0.4}, {1, 5, top}, {2, 5, top}, {2, 5, 0.4}}})
    sewing.Add(BRepBuilderAPI_MakeFace(wire(corners), true).Face());
  sewing.Perform();
  return BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape())).Solid();
}

/// A ring with a flat end, so that a slit is left.
inline TopoDS_Shape ring_with_slit(double width) {
  return prism(
      {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3 - width}, {0, 3 - width}});
}

} // namespace dovetail::testing
