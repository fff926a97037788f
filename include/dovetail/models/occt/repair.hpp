/// @file
/// The single repairs that healing chooses from. Each keeps the names of faces and solids.
#pragma once

#include "dovetail/models/occt/shape.hpp"

#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Face.hxx>
#include <ShapeFix_FixSmallFace.hxx>
#include <ShapeFix_Shape.hxx>
#include <ShapeFix_Wire.hxx>
#include <ShapeFix_Wireframe.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>

#include <string>
#include <vector>

namespace dovetail::occt {

/// In the cube of the shape's unit. (Without a bound on the error the kernel takes a fixed number of points
/// per face, and is off by a thousandth and more on spline surfaces.)
inline double volume_of(const TopoDS_Shape& shape, double relative_error) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties, relative_error);
  return properties.Mass();
}

/// ShapeFix on the whole shape: wires, missing curves and seams, orientation of faces and shells.
inline void fix_shape(attributed_shape& input) {
  ShapeFix_Shape fix(input.shape);
  fix.Perform();
  const TopoDS_Shape before = input.shape;
  input.shape = fix.Shape();
  inherit_attributes(input.names, before, [&](const TopoDS_Shape& old) { return fix.Context()->Apply(old); });
}

/// ShapeFix on single faces, whose curves are made to agree and whose edges are cut where they cross.
inline void fix_faces(attributed_shape& input, const std::vector<TopoDS_Face>& faces) {
  const Handle(ShapeBuild_ReShape) context = new ShapeBuild_ReShape;
  const TopoDS_Shape before = input.shape;
  for (const TopoDS_Face& face : faces) {
    BRepLib::SameParameter(face, 1e-7, true);
    ShapeFix_Face fix(face);
    fix.SetContext(context);
    fix.FixWireTool()->FixSelfIntersectionMode() = 1;
    fix.FixWireTool()->FixLackingMode() = 1;
    fix.Perform();
  }
  input.shape = context->Apply(before);
  inherit_attributes(input.names, before, [&](const TopoDS_Shape& old) { return context->Apply(old); });
}

/// Joins edges shorter than `size` to their neighbours and removes faces narrower than that.
inline void remove_small_entities(attributed_shape& input, double size) {
  const Handle(ShapeBuild_ReShape) context = new ShapeBuild_ReShape;
  const TopoDS_Shape before = input.shape;

  ShapeFix_FixSmallFace faces;
  faces.SetContext(context);
  faces.Init(input.shape);
  faces.SetPrecision(size);
  faces.Perform();

  ShapeFix_Wireframe edges(faces.FixShape());
  edges.SetContext(context);
  edges.SetPrecision(size);
  edges.SetMaxTolerance(10 * size);
  edges.ModeDropSmallEdges() = true;
  edges.FixSmallEdges();
  edges.FixWireGaps();
  input.shape = edges.Shape();
  inherit_attributes(input.names, before, [&](const TopoDS_Shape& old) { return context->Apply(old); });
  fix_shape(input);
}

/// Sews all faces together to shells, which need not close. Returns what is open: the first free edge, or an
/// empty text when all shells are closed.
inline std::string sew_shells(attributed_shape& input, double tolerance) {
  BRepBuilderAPI_Sewing sewing(tolerance);
  const TopTools_IndexedMapOfShape faces = sub_shapes(input.shape, TopAbs_FACE);
  for (int i = 1; i <= faces.Extent(); ++i)
    sewing.Add(faces(i));
  sewing.Perform();
  inherit_attributes(input.names, input.shape, [&](const TopoDS_Shape& old) {
    return old.ShapeType() == TopAbs_FACE && sewing.IsModified(old) ? sewing.Modified(old) : old;
  });
  input.shape = sewing.SewedShape();
  if (sewing.NbFreeEdges() == 0)
    return {};
  TopoDS_Vertex first, last;
  TopExp::Vertices(sewing.FreeEdge(1), first, last);
  return std::to_string(sewing.NbFreeEdges()) + " edges belong to one face only, the first from " +
         to_text(to_vec3(BRep_Tool::Pnt(first))) + " to " + to_text(to_vec3(BRep_Tool::Pnt(last)));
}

/// The same, and makes a solid of each shell.
inline std::string sew_faces(attributed_shape& input, double tolerance) {
  std::string open = sew_shells(input, tolerance);
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  const TopTools_IndexedMapOfShape shells = sub_shapes(input.shape, TopAbs_SHELL);
  for (int i = 1; i <= shells.Extent(); ++i)
    builder.Add(all, BRepBuilderAPI_MakeSolid(TopoDS::Shell(shells(i))).Solid());
  input.shape = all;
  return open;
}

} // namespace dovetail::occt
