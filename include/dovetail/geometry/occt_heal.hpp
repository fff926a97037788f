/// @file
/// Repair of shapes, in steps of growing force, each taken only when the steps before left faults.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/geometry/occt_topology.hpp"

#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Shape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::occt {

inline double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

/// ShapeFix on the whole shape: wires, missing curves and seams, face and shell orientation.
inline void fix_shape(attributed_shape& input) {
  ShapeFix_Shape fix(input.shape);
  fix.Perform();
  const TopoDS_Shape before = input.shape;
  input.shape = fix.Shape();
  inherit_attributes(input.names, before, [&](const TopoDS_Shape& old) { return fix.Context()->Apply(old); });
}

/// Sews all faces together at the given tolerance and makes a solid of each closed shell.
inline void sew_faces(attributed_shape& input, double tolerance) {
  BRepBuilderAPI_Sewing sewing(tolerance);
  const TopTools_IndexedMapOfShape faces = sub_shapes(input.shape, TopAbs_FACE);
  for (int i = 1; i <= faces.Extent(); ++i)
    sewing.Add(faces(i));
  sewing.Perform();
  inherit_attributes(input.names, input.shape, [&](const TopoDS_Shape& old) {
    return old.ShapeType() == TopAbs_FACE && sewing.IsModified(old) ? sewing.Modified(old) : old;
  });
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  const TopTools_IndexedMapOfShape shells = sub_shapes(sewing.SewedShape(), TopAbs_SHELL);
  for (int i = 1; i <= shells.Extent(); ++i) {
    BRepBuilderAPI_MakeSolid solid(TopoDS::Shell(shells(i)));
    builder.Add(all, solid.Solid());
  }
  input.shape = all;
}

/// Turns solids inside out whose shells enclose a negative volume.
inline void orient_solids(attributed_shape& input) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  const TopTools_IndexedMapOfShape solids = sub_shapes(input.shape, TopAbs_SOLID);
  for (int i = 1; i <= solids.Extent(); ++i) {
    TopoDS_Solid solid = TopoDS::Solid(solids(i));
    if (solid.Orientation() != TopAbs_FORWARD)
      solid.Orientation(TopAbs_FORWARD);
    if (volume_of(solid) < 0)
      solid.Reverse();
    builder.Add(all, solid);
  }
  input.shape = all;
}

inline brep healed_brep(attributed_shape input, report& made) {
  if (sub_shapes(input.shape, TopAbs_FACE).Extent() == 0)
    throw geometry_error(input.source + ": the shape has no faces");
  const bool had_solids = sub_shapes(input.shape, TopAbs_SOLID).Extent() > 0;
  if (!had_solids) {
    sew_faces(input, 1e-3);
    made.warnings.push_back("the shape has no solid; its faces were sewn");
  }
  if (sub_shapes(input.shape, TopAbs_SOLID).Extent() == 0)
    throw geometry_error(input.source + ": the shape has no solid and its faces enclose none");
  orient_solids(input);
  brep data = brep_builder(input.shape, input.names).build();
  if (!data.faults.empty()) {
    fix_shape(input);
    orient_solids(input);
    data = brep_builder(input.shape, input.names).build();
    made.warnings.push_back("the shape was repaired");
  }
  if (!data.faults.empty())
    throw geometry_error(input.source + ": " + data.faults.front());
  return data;
}

} // namespace dovetail::occt
