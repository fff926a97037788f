/// @file
/// Bars that are bent to a ring, and touch themselves, or nearly do.
#pragma once

#include "dovetail/core/vector.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include <cstddef>
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

/// The same, and it goes through its other end; the lids are of two parts, neither of which crosses itself.
inline TopoDS_Shape ring_through_itself() {
  const std::vector<gp_Pnt> outline{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},     {0, 3, 0},
                                    {3, 3, 0}, {3, 1, 0}, {1, 1, 0}, {0.5, 3.5, 0}, {0, 1, 0}};
  BRepBuilderAPI_Sewing sewing;
  const auto add = [&](const std::vector<gp_Pnt>& corners) {
    BRepBuilderAPI_MakePolygon polygon;
    for (const gp_Pnt& p : corners)
      polygon.Add(p);
    polygon.Close();
    sewing.Add(BRepBuilderAPI_MakeFace(polygon.Wire(), true).Face());
  };
  const auto at = [&](std::size_t k, double z) {
    const gp_Pnt& p = outline[k % outline.size()];
    return gp_Pnt(p.X(), p.Y(), z);
  };
  for (std::size_t k = 0; k < outline.size(); ++k)
    add({at(k, 0), at(k + 1, 0), at(k + 1, 1), at(k, 1)});
  for (const double z : {0.0, 1.0})
    for (const std::vector<std::size_t>& part :
         {std::vector<std::size_t>{1, 2, 3, 4, 5, 6}, std::vector<std::size_t>{0, 1, 6, 7, 8, 9}}) {
      std::vector<gp_Pnt> corners;
      for (const std::size_t k : part)
        corners.push_back(at(k, z));
      add(corners);
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

/// A ring with a flat end, so that a slit is left.
inline TopoDS_Shape ring_with_slit(double width) {
  return prism(
      {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3 - width}, {0, 3 - width}});
}

} // namespace dovetail::testing
