/// @file
/// Bars that are bent to a ring, and touch themselves, or nearly do.
#pragma once

#include "dovetail/core/vector.hpp"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <TopoDS_Shape.hxx>
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

/// The same with a flat end, so that a slit is left.
inline TopoDS_Shape ring_with_slit(double width) {
  return prism(
      {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3 - width}, {0, 3 - width}});
}

} // namespace dovetail::testing
