/// @file
/// What becomes of faces that are made to share what they have in common.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/models/occt/brep.hpp"
#include "dovetail/models/occt/imprint.hpp"

#include <BOPAlgo_Builder.hxx>
#include <BOPAlgo_BuilderFace.hxx>
#include <BOPTools_AlgoTools.hxx>
#include <BRep_Builder.hxx>
#include <NCollection_DataMap.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dovetail::occt {

/// The general fuse of the faces of a model at a tolerance, and what became of each. A face that touches
/// itself, as with a hole that reaches its outer boundary, ends there on both sides.
class fused_faces {
public:
  /// False when OCCT fails. The fuse does not compare the parts of one argument, and what several have is a
  /// part of the first one of them.
  /// \param data the model
  /// \param tolerance a length
  /// \param with_edges whether edges are arguments of their own, before the faces: then those of one face are
  ///        compared too; none may be as short as the tolerance
  bool perform(const brep& data, double tolerance, bool with_edges) {
    std::vector<TopoDS_Shape> arguments;
    for (std::size_t c = 0; with_edges && c < data.edges.size(); ++c)
      if (!data.topology.curves[c].degenerate)
        arguments.push_back(data.edges[c]);
    append(arguments, data.faces);
    return perform_fuse(fuse_, arguments, tolerance);
  }

  /// The parts of a face, as those of one that is FORWARD.
  const std::vector<TopoDS_Face>& parts_of(const TopoDS_Face& face) {
    if (const auto* known = parts_.Seek(face))
      return *known;
    parts_.Bind(face, made_of(TopoDS::Face(face.Oriented(TopAbs_FORWARD))));
    return parts_(face);
  }

  /// The same for what `inherit_attributes` asks for: of a shape that is no face there is nothing.
  TopoDS_Compound compound_of(const TopoDS_Shape& old) {
    const BRep_Builder builder;
    TopoDS_Compound all;
    builder.MakeCompound(all);
    if (old.ShapeType() == TopAbs_FACE)
      for (const TopoDS_Face& part : parts_of(TopoDS::Face(old)))
        builder.Add(all, part);
    return all;
  }

private:
  /// A part of an edge of a face, as the face passes it.
  struct edge_part {
    TopoDS_Edge made;
    TopoDS_Edge of;
  };

  std::vector<TopoDS_Face> made_of(const TopoDS_Face& face) {
    const TopTools_ListOfShape& images = fuse_.Modified(face);
    if (images.IsEmpty())
      return fuse_.IsDeleted(face) ? std::vector<TopoDS_Face>{} : std::vector{face};
    std::vector<TopoDS_Face> parts;
    const auto boundary = boundary_of(face);
    if (std::none_of(boundary.begin(), boundary.end(),
                     [&](const edge_part& part) { return is_passed_back(part, boundary); })) {
      for (const TopoDS_Shape& image : images)
        parts.push_back(TopoDS::Face(image));
      return parts;
    }
    BOPAlgo_BuilderFace builder;
    builder.SetFace(face);
    builder.SetShapes(edges_of_parts(images, boundary));
    builder.Perform();
    for (const TopoDS_Shape& part : builder.Areas())
      parts.push_back(TopoDS::Face(part));
    return parts;
  }

  std::vector<edge_part> boundary_of(const TopoDS_Face& face) {
    std::vector<edge_part> boundary;
    for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge passed = TopoDS::Edge(edges.Current());
      const TopoDS_Edge forward = TopoDS::Edge(passed.Oriented(TopAbs_FORWARD));
      const TopTools_ListOfShape& images = fuse_.Modified(forward);
      for (const TopoDS_Shape& image : images) {
        const TopoDS_Edge part = TopoDS::Edge(image.Oriented(TopAbs_FORWARD));
        const bool turned = BOPTools_AlgoTools::IsSplitToReverse(part, forward, fuse_.Context());
        const TopoDS_Shape oriented = part.Oriented(passed.Orientation());
        boundary.push_back({TopoDS::Edge(turned ? oriented.Reversed() : oriented), passed});
      }
      if (images.IsEmpty())
        boundary.push_back({passed, passed});
    }
    return boundary;
  }

  /// Whether the same is passed the other way along another edge of the face: no seam, nor a curve that lies
  /// inside of it.
  static bool is_passed_back(const edge_part& part, const std::vector<edge_part>& boundary) {
    return std::any_of(boundary.begin(), boundary.end(), [&](const edge_part& other) {
      return other.made.IsSame(part.made) && !other.made.IsEqual(part.made) && !other.of.IsSame(part.of);
    });
  }

  /// Those of the boundary of a face that touches itself, and those that divide it.
  static TopTools_ListOfShape edges_of_parts(const TopTools_ListOfShape& images,
                                             const std::vector<edge_part>& boundary) {
    TopTools_ListOfShape edges;
    for (const edge_part& part : boundary)
      if (!is_passed_back(part, boundary))
        edges.Append(part.made);
    for (const TopoDS_Shape& image : images)
      for (TopExp_Explorer each(image.Oriented(TopAbs_FORWARD), TopAbs_EDGE); each.More(); each.Next())
        if (std::none_of(boundary.begin(), boundary.end(),
                         [&](const edge_part& part) { return part.made.IsSame(each.Current()); }))
          edges.Append(each.Current());
    return edges;
  }

  BOPAlgo_Builder fuse_;
  NCollection_DataMap<TopoDS_Shape, std::vector<TopoDS_Face>, TopTools_ShapeMapHasher> parts_;
};

} // namespace dovetail::occt
