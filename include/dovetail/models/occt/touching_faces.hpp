/// @file
/// Faces that touch, or nearly do, without sharing what they have in common: also those of one solid, such as
/// a pin in a slot as wide as the pin, or two sides of a slit.
#pragma once

#include "dovetail/models/occt/heal.hpp"

#include <BOPAlgo_Builder.hxx>
#include <TopTools_MapOfShape.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail::occt {

/// One passage of a face along an edge, as seen along the edge.
struct passage_at_edge {
  double angle; ///< of the face's direction away from the edge, around it
  int enters;   ///< 1 where a turn around the edge enters the solid there, -1 where it leaves it
};

/// The passages of each edge, by faces of one solid.
inline std::vector<std::vector<passage_at_edge>> passages_of_edges(const brep& data, local_id solid) {
  std::vector<std::vector<passage_at_edge>> passages(data.edges.size());
  std::vector<std::array<vec3, 2>> axes(data.edges.size());
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    const auto& face = data.topology.faces[f];
    if (face.solids[0] != solid && face.solids[1] != solid)
      continue;
    const bool flipped = face.reversed != (face.solids[0] != solid);
    for (std::size_t k = 0; k < face.coedges.size(); ++k) {
      const auto c = static_cast<std::size_t>(face.coedges[k].curve);
      if (data.topology.curves[c].degenerate)
        continue;
      const auto& t = data.topology.curves[c].t;
      const double middle = 0.5 * (t[0] + t[1]);
      gp_Pnt point;
      gp_Vec derivative;
      data.curves[c].D1(middle, point, derivative);
      const vec3 along = normalized(to_vec3(derivative.XYZ()));
      const surface_frame frame = data.surfaces[f].frame(data.coedges[f][k].at(middle, data.surfaces[f]));
      const vec3 normal = normalized(cross(frame.du, frame.dv));
      const vec3 away = (face.coedges[k].reversed ? -1.0 : 1.0) * cross(normal, along);
      auto& [first, second] = axes[c];
      if (passages[c].empty()) {
        first = normalized(away);
        second = cross(along, first);
      }
      const vec3 outwards = (flipped ? -1.0 : 1.0) * normal;
      passages[c].push_back(
          {std::atan2(dot(away, second), dot(away, first)), dot(outwards, cross(along, away)) > 0 ? -1 : 1});
    }
  }
  return passages;
}

/// Whether the sectors of a solid around one of its edges lie beside each other. Where its surface passes
/// through itself some lie in others. Faces that are tangent to each other may be in any order.
inline bool sectors_are_apart(std::vector<passage_at_edge> passages) {
  constexpr double tangent = 0.05; // radians
  std::sort(passages.begin(), passages.end(), [](const auto& a, const auto& b) { return a.angle < b.angle; });
  // Directions on both sides of the cut of the angle belong together: turn it away from them.
  std::size_t first = 0;
  double widest = passages.front().angle + 2 * std::numbers::pi - passages.back().angle;
  for (std::size_t k = 1; k < passages.size(); ++k)
    if (const double gap = passages[k].angle - passages[k - 1].angle; gap > widest) {
      widest = gap;
      first = k;
    }
  std::rotate(passages.begin(), passages.begin() + static_cast<std::ptrdiff_t>(first), passages.end());
  int depth = 0, least = 0, most = 0;
  for (std::size_t k = 0; k < passages.size(); ++k) {
    depth += passages[k].enters;
    const bool ends_group =
        k + 1 == passages.size() ||
        std::abs(std::remainder(passages[k + 1].angle - passages[k].angle, 2 * std::numbers::pi)) > tangent;
    if (ends_group) {
      least = std::min(least, depth);
      most = std::max(most, depth);
    }
  }
  return most - least <= 1;
}

/// Whether no solid passes through itself where it touches itself.
inline bool only_touches_itself(const brep& data) {
  for (std::size_t s = 0; s < data.solids.size(); ++s)
    for (const auto& passages : passages_of_edges(data, static_cast<local_id>(s)))
      if (passages.size() > 2 && !sectors_are_apart(passages))
        return false;
  return true;
}

/// The faces of a body as the fuse made them. Those that are both sides of one and the same solid bound
/// nothing any more.
/// \param body a solid or a face
/// \param fuse the general fuse of all faces, each as FORWARD
inline TopoDS_Shape body_of_images(const TopoDS_Shape& body, BOPAlgo_Builder& fuse) {
  std::vector<TopoDS_Shape> images;
  for (TopExp_Explorer faces(body, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Shape& face = faces.Current();
    const TopTools_ListOfShape& made = fuse.Modified(face);
    for (const TopoDS_Shape& image : made) // as if the face were FORWARD
      images.push_back(face.Orientation() == TopAbs_REVERSED ? image.Reversed() : image);
    if (made.IsEmpty() && !fuse.IsDeleted(face))
      images.push_back(face);
  }
  TopTools_MapOfShape once, twice;
  for (const TopoDS_Shape& image : images)
    if (!once.Add(image))
      twice.Add(image);
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (const TopoDS_Shape& image : images)
    if (!twice.Contains(image))
      builder.Add(shell, image);
  if (body.ShapeType() == TopAbs_FACE)
    return shell;
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

/// The general fuse of all faces at a tolerance, and the bodies made of them again. Empty when OCCT fails.
inline std::optional<attributed_shape> fuse_of_faces(const attributed_shape& input, const brep& data,
                                                     double tolerance) {
  BOPAlgo_Builder fuse;
  for (const TopoDS_Face& face : data.faces)
    fuse.AddArgument(face);
  fuse.SetNonDestructive(true);
  fuse.SetFuzzyValue(tolerance);
  fuse.Perform();
  if (fuse.HasErrors())
    return std::nullopt;
  const BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  attributed_shape result = input;
  for (const TopoDS_Shape& body : bodies_of(data)) {
    const TopoDS_Shape made = body_of_images(body, fuse);
    result.names.inherit(made, body);
    builder.Add(all, made);
  }
  inherit_attributes(result.names, input.shape, [&](const TopoDS_Shape& old) {
    TopoDS_Compound images;
    builder.MakeCompound(images);
    if (old.ShapeType() == TopAbs_FACE)
      for (TopTools_ListIteratorOfListOfShape image(fuse.Modified(old)); image.More(); image.Next())
        builder.Add(images, image.Value());
    return images;
  });
  result.shape = all;
  return result;
}

/// Makes faces share what they have in common, where they touch or are within `tolerance` of each other; both
/// sides of a slit as narrow as that vanish. False, and nothing is changed, where there is nothing of the
/// kind, or what would come out is not sound: a solid is gone or open, or passes through itself.
/// Complexity: that of OpenCASCADE's general fuse of all faces, a few milliseconds for each.
/// \param tolerance a length; with 0 faces have to touch within the tolerances of the file
/// \param made is told of repairs of slivers that the tolerance leaves
inline bool join_touching_faces(attributed_shape& input, brep& data, report& made, wanted what,
                                double tolerance) {
  try {
    auto joined = fuse_of_faces(input, data, tolerance);
    if (!joined)
      return false;
    brep found = brep_builder(joined->shape, joined->names).build();
    report repairs;
    if (!found.faults.empty() && !repair_faults(*joined, found, repairs, what))
      return false;
    if (found.solids.size() != data.solids.size() || entity_counts(found) == entity_counts(data) ||
        !only_touches_itself(found))
      return false;
    data = std::move(found);
    input = *std::move(joined);
    append(made.warnings, repairs.warnings);
    return true;
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure&) { // the general fuse cannot cope with the shape
    return false;
  }
}

} // namespace dovetail::occt
