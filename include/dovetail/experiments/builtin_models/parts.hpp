/// @file
/// The parts that built-in models are made of, and their difference from a far-field box.
#pragma once

#include "dovetail/models/occt/shape.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Builder.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Ax1.hxx>
#include <gp_Dir.hxx>
#include <gp_Vec.hxx>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace dovetail::builtin {

/// A solid whose faces all get one name.
struct named_part {
  TopoDS_Shape shape; ///< the solid
  std::string name;   ///< of all its faces
};

/// The smooth curve through points at given parameters, with the derivatives given at its ends.
inline TopoDS_Edge spline_edge(const std::vector<vec3>& points, const std::vector<double>& parameters,
                               vec3 first_derivative, vec3 last_derivative) {
  const int count = static_cast<int>(points.size());
  const Handle(TColgp_HArray1OfPnt) at = new TColgp_HArray1OfPnt(1, count);
  const Handle(TColStd_HArray1OfReal) t = new TColStd_HArray1OfReal(1, count);
  for (int i = 0; i < count; ++i) {
    at->SetValue(i + 1, occt::to_pnt(points[i]));
    t->SetValue(i + 1, parameters[i]);
  }
  GeomAPI_Interpolate interpolation(at, t, false, 1e-9);
  const auto vec = [](vec3 v) { return gp_Vec(v.x, v.y, v.z); };
  interpolation.Load(vec(first_derivative), vec(last_derivative), false);
  interpolation.Perform();
  return BRepBuilderAPI_MakeEdge(interpolation.Curve()).Edge();
}

/// One section of a wing: leading edge, chord along x, thickness relative to the chord.
struct wing_section {
  vec3 leading_edge;       ///< the foremost point
  double chord = 1;        ///< its length along x
  double thickness = 0.08; ///< of the chord
};

/// A section's outline: one curve over each side, smooth at the leading edge, sharp at the trailing edge.
/// The symmetric four-digit NACA section with a closed trailing edge, a polynomial in the square root of the
/// distance from the leading edge. `up` is the direction of the thickness.
inline TopoDS_Wire section_wire(const wing_section& section, vec3 up) {
  constexpr int intervals = 12;
  const auto height = [](double s) {
    const double x = s * s;
    return 5 * (0.2969 * s + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - x * 0.1036))));
  };
  const double last_slope = 5 * (0.2969 - 2 * 0.1260 - 4 * 0.3516 + 6 * 0.2843 - 8 * 0.1036);
  const auto side = [&](double sign) {
    const vec3 along = section.chord * vec3{1, 0, 0};
    const vec3 across = sign * section.chord * section.thickness * up;
    std::vector<vec3> points;
    std::vector<double> parameters;
    for (int i = 0; i <= intervals; ++i) {
      const double s = static_cast<double>(i) / intervals;
      parameters.push_back(s);
      points.push_back(section.leading_edge + s * s * along + (i == intervals ? 0 : height(s)) * across);
    }
    return spline_edge(points, parameters, 5 * 0.2969 * across, 2.0 * along + last_slope * across);
  };
  const TopoDS_Edge upper = side(1), lower = side(-1);
  return BRepBuilderAPI_MakeWire(upper, TopoDS::Edge(lower.Reversed())).Wire();
}

/// The ruled solid between sections, flat at both ends.
inline TopoDS_Shape lifting_surface(const std::vector<wing_section>& sections, vec3 up) {
  BRepOffsetAPI_ThruSections loft(true, true);
  for (const auto& section : sections)
    loft.AddWire(section_wire(section, up));
  loft.CheckCompatibility(false);
  loft.Build();
  return loft.Shape();
}

/// The solid made by turning a profile around the axis through `nose` along x. `profile` lists (x, radius)
/// from the nose (radius 0, blunt) to the tail. A tail radius above zero is closed by a flat base, which the
/// body meets parallel to the axis; a tail radius of zero is blunt too. The seam is at the bottom (-z).
inline TopoDS_Shape body_of_revolution(vec3 nose, const std::vector<vec2>& profile) {
  std::vector<vec3> points;
  std::vector<double> lengths;
  for (const auto& p : profile) {
    points.push_back(nose + vec3{p.x, 0, -p.y});
    lengths.push_back(lengths.empty() ? 0.0
                                      : lengths.back() + distance(points.back(), points[points.size() - 2]));
  }
  const bool closed_tail = profile.back().y == 0;
  const vec3 tail_tangent = closed_tail ? vec3{0, 0, 1} : vec3{1, 0, 0};
  BRepBuilderAPI_MakeWire outline(spline_edge(points, lengths, {0, 0, -1}, tail_tangent));
  const vec3 tail = nose + vec3{profile.back().x, 0, 0};
  if (!closed_tail)
    outline.Add(BRepBuilderAPI_MakeEdge(occt::to_pnt(points.back()), occt::to_pnt(tail)).Edge());
  outline.Add(BRepBuilderAPI_MakeEdge(occt::to_pnt(tail), occt::to_pnt(nose)).Edge());
  const TopoDS_Face half_plane = BRepBuilderAPI_MakeFace(outline.Wire(), true).Face();
  return BRepPrimAPI_MakeRevol(half_plane, gp_Ax1(occt::to_pnt(nose), gp_Dir(1, 0, 0))).Shape();
}

/// Profile of a body with an elliptic nose and an elliptic tail, cylindrical in between.
inline std::vector<vec2> spindle_profile(double length, double radius, double nose, double tail) {
  constexpr int intervals = 8;
  std::vector<vec2> profile;
  for (int i = 0; i <= intervals; ++i) {
    const double a = 0.5 * std::numbers::pi * i / intervals;
    profile.push_back({nose * (1 - std::cos(a)), radius * std::sin(a)});
  }
  const double straight = length - nose - tail;
  for (const double s : {0.25, 0.5, 0.75})
    profile.push_back({nose + s * straight, radius});
  for (int i = intervals; i >= 0; --i) {
    const double a = 0.5 * std::numbers::pi * i / intervals;
    profile.push_back({length - tail * (1 - std::cos(a)), i == 0 ? 0 : radius * std::sin(a)});
  }
  return profile;
}

/// Gives all faces of a shape one name.
inline void name_faces(occt::attribute_map& names, const TopoDS_Shape& shape, const std::string& name) {
  const TopTools_IndexedMapOfShape faces = occt::sub_shapes(shape, TopAbs_FACE);
  for (int i = 1; i <= faces.Extent(); ++i)
    names[faces(i)].name = name;
}

/// `whole` minus all parts (which may overlap each other); faces keep the names of what they come from.
inline occt::attributed_shape difference(const named_part& whole, const std::vector<named_part>& parts) {
  occt::attributed_shape result;
  BRepAlgoAPI_Cut cut;
  TopTools_ListOfShape arguments, tools;
  arguments.Append(whole.shape);
  name_faces(result.names, whole.shape, whole.name);
  for (const auto& part : parts) {
    tools.Append(part.shape);
    name_faces(result.names, part.shape, part.name);
  }
  cut.SetArguments(arguments);
  cut.SetTools(tools);
  cut.Build();
  if (!cut.IsDone())
    throw geometry_error("built-in model: the Boolean difference failed");
  const auto image_of = [&](const TopoDS_Shape& old) {
    TopoDS_Compound images;
    const BRep_Builder builder;
    builder.MakeCompound(images);
    for (TopTools_ListIteratorOfListOfShape image(cut.Modified(old)); image.More(); image.Next())
      builder.Add(images, image.Value());
    return images;
  };
  inherit_attributes(result.names, whole.shape, image_of);
  for (const auto& part : parts)
    inherit_attributes(result.names, part.shape, image_of);
  result.shape = cut.Shape();
  return result;
}

/// A box between two corners.
inline TopoDS_Shape box(vec3 lower, vec3 upper) {
  return BRepPrimAPI_MakeBox(occt::to_pnt(lower), occt::to_pnt(upper)).Shape();
}

} // namespace dovetail::builtin
