/// @file
/// Faces on spheres whose inaccurate edges pass by a pole: there the smallest error turns a parameter curve
/// around the pole. Such a face gets the same sphere with its poles and its seam elsewhere.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/models/occt/surface.hpp"
#include "dovetail/models/occt/topology.hpp"

#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <Geom_SphericalSurface.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <gp_Ax3.hxx>
#include <gp_Sphere.hxx>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace dovetail::occt {

/// Whether a face passes an edge for the parameter plane's sake alone: a pole, or a seam there and back.
inline bool is_of_parameters(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  int passages = 0;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next())
    passages += edges.Current().IsSame(edge) ? 1 : 0;
  return BRep_Tool::Degenerated(edge) || passages > 1;
}

/// The sphere of a face with a pole and an edge less accurate than a hundredth of the radius.
inline std::optional<gp_Sphere> inaccurate_sphere(const TopoDS_Face& face) {
  const face_surface surface(face);
  if (surface.adaptor().GetType() != GeomAbs_Sphere)
    return std::nullopt;
  const gp_Sphere sphere = surface.adaptor().Sphere();
  bool pole = false, inaccurate = false;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
    pole = pole || BRep_Tool::Degenerated(edge);
    inaccurate =
        inaccurate || (!is_of_parameters(edge, face) && BRep_Tool::Tolerance(edge) > 1e-2 * sphere.Radius());
  }
  return pole && inaccurate ? std::optional(sphere) : std::nullopt;
}

/// Directions from a sphere's centre to points on the edges of a face.
inline std::vector<vec3> directions_of_boundary(const TopoDS_Face& face, vec3 centre) {
  constexpr int samples = 16;
  std::vector<vec3> directions;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
    double t0 = 0, t1 = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
    if (curve.IsNull() || is_of_parameters(edge, face))
      continue;
    for (int i = 0; i <= samples; ++i)
      directions.push_back(normalized(to_vec3(curve->Value(t0 + (t1 - t0) * i / samples)) - centre));
  }
  return directions;
}

/// The position of a sphere of which some directions are far from the poles and the seam; none when there is
/// none. `middle` is seen in the middle of the parameter plane.
inline std::optional<gp_Ax3> turned_position(const gp_Ax3& given, const std::vector<vec3>& directions,
                                             vec3 middle) {
  constexpr int candidates = 36;
  constexpr double pi = 3.14159265358979323846, highest = 0.97, past_seam = -0.97;
  const vec3 other = normalized(cross(middle, std::abs(middle.x) < 0.6 ? vec3{1, 0, 0} : vec3{0, 1, 0}));
  const vec3 third = cross(middle, other);
  vec3 best{};
  double least = highest;
  for (int i = 0; i < candidates; ++i) {
    const vec3 axis = std::cos(pi * i / candidates) * other + std::sin(pi * i / candidates) * third;
    double height = 0, far = 1; // cosine of the largest longitude
    for (const vec3 d : directions) {
      const vec3 level = d - dot(d, axis) * axis;
      height = std::max(height, std::abs(dot(d, axis)));
      far = std::min(far, dot(normalized(level), middle));
    }
    if (height < least && far > past_seam) {
      least = height;
      best = axis;
    }
  }
  if (!(least < highest))
    return std::nullopt;
  gp_Ax3 turned(given.Location(), gp_Dir(best.x, best.y, best.z), gp_Dir(-middle.x, -middle.y, -middle.z));
  if (!given.Direct())
    turned.YReverse();
  return turned;
}

/// In the square of the shape's unit.
inline double area_of(const TopoDS_Face& face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return properties.Mass();
}

/// The face on the turned sphere, without poles and seams; null when that is not possible. Beyond a
/// hemisphere the middle of the boundary lies outside of the face, and the boundary would enclose what is not
/// the face: its area tells.
inline TopoDS_Face turned_face(const TopoDS_Face& given, const gp_Sphere& sphere) {
  const TopoDS_Face face = TopoDS::Face(given.Oriented(TopAbs_FORWARD));
  const auto directions = directions_of_boundary(face, to_vec3(sphere.Location()));
  vec3 sum{};
  for (const vec3 d : directions)
    sum += d;
  if (!(norm(sum) > 0))
    return {};
  const auto position = turned_position(sphere.Position(), directions, normalized(sum));
  if (!position)
    return {};
  TopoDS_Face turned;
  const BRep_Builder builder;
  builder.MakeFace(turned, new Geom_SphericalSurface(*position, sphere.Radius()), BRep_Tool::Tolerance(face));
  for (TopoDS_Iterator wires(face); wires.More(); wires.Next()) {
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    for (TopoDS_Iterator edges(wires.Value()); edges.More(); edges.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(edges.Value());
      if (is_of_parameters(edge, face))
        continue;
      builder.Add(wire, edge);
      ShapeFix_Edge().FixAddPCurve(edge, turned, false);
    }
    if (!TopoDS_Iterator(wire).More())
      return {};
    builder.Add(turned, wire);
  }
  constexpr double largest_change = 0.1; // of an area whose edges are not accurate
  if (const double area = area_of(turned); !(std::abs(area - area_of(face)) <= largest_change * area))
    return {};
  return TopoDS::Face(turned.Oriented(given.Orientation()));
}

/// Turns the spheres of inaccurate faces at poles.
inline void turn_spheres(attributed_shape& input, report& made) {
  const Handle(ShapeBuild_ReShape) context = new ShapeBuild_ReShape;
  const TopTools_IndexedMapOfShape faces = sub_shapes(input.shape, TopAbs_FACE);
  std::size_t turned = 0;
  for (int i = 1; i <= faces.Extent(); ++i) {
    const TopoDS_Face face = TopoDS::Face(faces(i));
    if (const auto sphere = inaccurate_sphere(face))
      if (const TopoDS_Face better = turned_face(face, *sphere); !better.IsNull()) {
        context->Replace(face, better);
        ++turned;
      }
  }
  if (turned == 0)
    return;
  const TopoDS_Shape before = input.shape;
  input.shape = context->Apply(before);
  inherit_attributes(input.names, before, [&](const TopoDS_Shape& old) { return context->Apply(old); });
  made.warnings.push_back(
      std::to_string(turned) +
      " faces on spheres, with inaccurate edges near a pole, had their poles turned away");
}

} // namespace dovetail::occt
