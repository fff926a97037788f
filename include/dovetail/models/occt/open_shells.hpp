/// @file
/// Shapes whose faces need not enclose anything: open shells, single faces, plane domains with inner edges.
#pragma once

#include "dovetail/models/occt/repair.hpp"

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <TopTools_ListOfShape.hxx>

namespace dovetail::occt {

/// Whether some sub-shape of a kind is in no shape of another kind.
inline bool has_free(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum in) {
  return TopExp_Explorer(shape, kind, in).More();
}

/// Lets edges that lie in no face, such as the inner lines of a drawing, divide the faces that they lie on or
/// become inner edges of them. Throws `geometry_error` when that fails.
inline void imprint_free_edges(attributed_shape& input) {
  TopTools_ListOfShape all;
  const TopTools_IndexedMapOfShape faces = sub_shapes(input.shape, TopAbs_FACE);
  for (int i = 1; i <= faces.Extent(); ++i)
    all.Append(faces(i));
  for (TopExp_Explorer edges(input.shape, TopAbs_EDGE, TopAbs_FACE); edges.More(); edges.Next())
    all.Append(edges.Current());
  BRepAlgoAPI_BuilderAlgo builder;
  builder.SetArguments(all);
  builder.Build();
  if (builder.HasErrors() || builder.Shape().IsNull())
    throw geometry_error(input.source + ": its free edges cannot be imprinted on its faces; divide the faces "
                                        "along them in the CAD system");
  const auto image_of = [&](const TopoDS_Shape& old) -> TopoDS_Shape {
    const TopTools_ListOfShape& parts = builder.Modified(old);
    if (parts.IsEmpty())
      return old;
    TopoDS_Compound image;
    const BRep_Builder compound;
    compound.MakeCompound(image);
    for (const TopoDS_Shape& part : parts)
      compound.Add(image, part);
    return image;
  };
  inherit_attributes(input.names, input.shape, image_of);
  input.shape = builder.Shape();
}

/// All faces of a shape without its solids, joined where their edges coincide within a tolerance.
inline void make_shells(attributed_shape& input, double tolerance) {
  if (sub_shapes(input.shape, TopAbs_FACE).Extent() > 1)
    sew_shells(input, tolerance);
}

} // namespace dovetail::occt
