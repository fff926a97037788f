/// @file
/// What becomes of faces that are made to share what they have in common.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
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

/// Some faces of a model, and all that hang together with one of them: with those of other bodies they share
/// no vertex.
inline std::vector<local_id> faces_connected_to(const brep& data, const std::vector<local_id>& faces) {
  disjoint_sets sets(data.topology.vertices.size());
  std::vector<local_id> vertex_of_face;
  for (const auto& face : data.topology.faces) {
    vertex_of_face.push_back(data.topology.curves[face.coedges.front().curve].vertices[0]);
    for (const auto& coedge : face.coedges)
      for (const local_id v : data.topology.curves[coedge.curve].vertices)
        sets.unite(vertex_of_face.back(), v);
  }
  std::vector<local_id> roots;
  for (const local_id f : faces)
    roots.push_back(sets.find(vertex_of_face[f]));
  sort_unique(roots);
  std::vector<local_id> connected;
  for (std::size_t f = 0; f < vertex_of_face.size(); ++f)
    if (std::binary_search(roots.begin(), roots.end(), sets.find(vertex_of_face[f])))
      connected.push_back(static_cast<local_id>(f));
  return connected;
}

/// The general fuse of faces of a model at a tolerance, and what became of each. A face that touches itself,
/// as with a hole that reaches its outer boundary, ends there on both sides.
class fused_faces {
public:
  /// Fuses all faces. False when OCCT fails.
  /// \param data the model
  /// \param tolerance a length
  bool perform(const brep& data, double tolerance) { return perform_fuse(fuse_, data.faces, tolerance); }

  /// Fuses some faces and what hangs together with them, with the edges of each face compared too: else the
  /// fuse does not compare the parts of one argument, and what several have is a part of the first one of
  /// them. False when OCCT fails, as where an edge is as short as the tolerance.
  /// \param data the model
  /// \param faces numbers of faces
  /// \param tolerance a length
  bool perform_with_edges(const brep& data, const std::vector<local_id>& faces, double tolerance) {
    const std::vector<local_id> fused = faces_connected_to(data, faces);
    std::vector<local_id> curves;
    for (const local_id f : fused)
      append(curves, edges_of_face(data, static_cast<std::size_t>(f)));
    sort_unique(curves);
    std::vector<TopoDS_Shape> arguments;
    for (const local_id c : curves)
      arguments.push_back(data.edges[c]);
    for (const local_id f : fused)
      arguments.push_back(data.faces[f]);
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

  using passages_of_edge = NCollection_DataMap<TopoDS_Shape, std::vector<edge_part>, TopTools_ShapeMapHasher>;

  std::vector<TopoDS_Face> made_of(const TopoDS_Face& face) {
    const TopTools_ListOfShape& images = fuse_.Modified(face);
    if (images.IsEmpty())
      return fuse_.IsDeleted(face) ? std::vector<TopoDS_Face>{} : std::vector{face};
    const auto boundary = boundary_of(face);
    const passages_of_edge passages = by_edge(boundary);
    std::vector<TopoDS_Face> parts;
    if (are_of_others(images) || std::none_of(boundary.begin(), boundary.end(), [&](const edge_part& part) {
          return is_passed_back(part, passages);
        })) {
      for (const TopoDS_Shape& image : images)
        parts.push_back(TopoDS::Face(image));
      return parts;
    }
    BOPAlgo_BuilderFace builder;
    builder.SetFace(face);
    builder.SetShapes(edges_of_parts(images, boundary, passages));
    builder.Perform();
    for (const TopoDS_Shape& part : builder.Areas())
      parts.push_back(TopoDS::Face(part));
    return parts;
  }

  /// Whether one of them is an image of another face as well.
  bool are_of_others(const TopTools_ListOfShape& images) const {
    return std::any_of(images.begin(), images.end(), [&](const TopoDS_Shape& image) {
      const TopTools_ListOfShape* origins = fuse_.Origins().Seek(image);
      return origins && origins->Extent() > 1;
    });
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

  static bool is_inside(const edge_part& part) {
    return part.made.Orientation() == TopAbs_INTERNAL || part.made.Orientation() == TopAbs_EXTERNAL;
  }

  /// The parts along which a face passes, by edge.
  static passages_of_edge by_edge(const std::vector<edge_part>& boundary) {
    passages_of_edge passages;
    for (const edge_part& part : boundary)
      if (!is_inside(part)) {
        if (!passages.IsBound(part.made))
          passages.Bind(part.made, {});
        passages(part.made).push_back(part);
      }
    return passages;
  }

  /// Whether the same is passed the other way along another edge of the face: no seam, nor a curve that lies
  /// inside of it.
  static bool is_passed_back(const edge_part& part, const passages_of_edge& passages) {
    const auto* all = is_inside(part) ? nullptr : passages.Seek(part.made);
    return all && std::any_of(all->begin(), all->end(), [&](const edge_part& other) {
             return other.made.Orientation() != part.made.Orientation() && !other.of.IsSame(part.of);
           });
  }

  /// Those of the boundary of a face that touches itself, those inside of it, and those that divide it.
  static TopTools_ListOfShape edges_of_parts(const TopTools_ListOfShape& images,
                                             const std::vector<edge_part>& boundary,
                                             const passages_of_edge& passages) {
    TopTools_ListOfShape edges;
    passages_of_edge inside;
    for (const edge_part& part : boundary)
      if (is_inside(part) ? !passages.IsBound(part.made) : !is_passed_back(part, passages)) {
        edges.Append(part.made);
        if (is_inside(part))
          inside.Bind(part.made, {});
      }
    for (const TopoDS_Shape& image : images)
      for (TopExp_Explorer each(image.Oriented(TopAbs_FORWARD), TopAbs_EDGE); each.More(); each.Next())
        if (!passages.IsBound(each.Current()) && !inside.IsBound(each.Current()))
          edges.Append(each.Current());
    return edges;
  }

  BOPAlgo_Builder fuse_;
  NCollection_DataMap<TopoDS_Shape, std::vector<TopoDS_Face>, TopTools_ShapeMapHasher> parts_;
};

} // namespace dovetail::occt
