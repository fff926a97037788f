/// @file
/// The built-in combustor liner: a thin cylinder with rows of small holes. Units: millimetres.
#pragma once

#include "dovetail/experiments/builtin_models/parts.hpp"

#include <BRepPrimAPI_MakeCylinder.hxx>
#include <gp_Ax2.hxx>

#include <cmath>
#include <numbers>
#include <vector>

namespace dovetail::builtin {

namespace combustor {

inline constexpr double outer_radius = 100; ///< of the liner
inline constexpr double thickness = 4;      ///< of its wall
inline constexpr double length = 240;       ///< of the liner, along x

/// A ring of equal holes, evenly spaced.
struct hole_row {
  double x;      ///< where the ring is
  double radius; ///< of each hole
  int holes;     ///< how many there are in the ring
  double phase;  ///< of the hole spacing
};

/// Staggered cooling holes with two rows of larger dilution holes among them.
inline std::vector<hole_row> hole_rows() {
  std::vector<hole_row> rows;
  for (int i = 0; i < 14; ++i) {
    const double x = 16 + 16.0 * i;
    const bool dilution = i == 4 || i == 9;
    rows.push_back({x, dilution ? 6.0 : 2.5, dilution ? 12 : 24, i % 2 == 0 ? 0.25 : 0.75});
  }
  return rows;
}

} // namespace combustor

/// The liner with its holes.
inline occt::attributed_shape combustor_shape() {
  using namespace combustor;
  const gp_Dir along(1, 0, 0);
  // The seams of all cylinders are turned away from the holes.
  const gp_Ax2 axis(gp_Pnt(0, 0, 0), along, gp_Dir(0, 1, 0));
  const TopoDS_Shape liner = BRepPrimAPI_MakeCylinder(axis, outer_radius, length).Shape();
  const gp_Ax2 inner_axis(gp_Pnt(-1, 0, 0), along, gp_Dir(0, 1, 0));
  std::vector<named_part> parts{
      {BRepPrimAPI_MakeCylinder(inner_axis, outer_radius - thickness, length + 2).Shape(), "inner"}};
  for (const auto& row : hole_rows()) {
    for (int i = 0; i < row.holes; ++i) {
      const double angle = 2 * std::numbers::pi * (i + row.phase) / row.holes;
      const gp_Dir outward(0, std::cos(angle), std::sin(angle));
      const double start = outer_radius - 2.5 * thickness;
      const gp_Pnt from(row.x, start * outward.Y(), start * outward.Z());
      parts.push_back(
          {BRepPrimAPI_MakeCylinder(gp_Ax2(from, outward, along), row.radius, 4 * thickness).Shape(),
           "holes"});
    }
  }
  occt::attributed_shape result = difference({liner, "outer"}, parts);
  const TopTools_IndexedMapOfShape faces = occt::sub_shapes(result.shape, TopAbs_FACE);
  for (int i = 1; i <= faces.Extent(); ++i)
    if (BRep_Tool::Surface(TopoDS::Face(faces(i)))->IsKind("Geom_Plane"))
      result.names[faces(i)].name = "ends";
  return result;
}

} // namespace dovetail::builtin
