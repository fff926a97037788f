/// @file
/// Faces that touch, or nearly do, without sharing what they have in common: also those of one solid, such as
/// a pin in a slot as wide as the pin, or two sides of a slit.
#pragma once

#include "dovetail/models/occt/fused_faces.hpp"
#include "dovetail/models/occt/heal.hpp"
#include "dovetail/models/occt/overlapping_edges.hpp"

#include <Precision.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::occt {

/// One passage of a face along an edge, as seen along the edge.
struct passage_at_edge {
  double angle; ///< of the face's direction away from the edge, around it
  int enters;   ///< 1 where a turn around the edge enters the solid there, -1 where it leaves it
};

/// The passages of each edge that faces of a solid pass more than twice, by edge and solid.
inline std::map<std::array<local_id, 2>, std::vector<passage_at_edge>> repeated_passages(const brep& data) {
  struct passage {
    std::size_t face, coedge;
    bool flipped; ///< the normal out of the solid is opposite to that of the surface
  };
  std::map<std::array<local_id, 2>, std::vector<passage>> all;
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    const auto& face = data.topology.faces[f];
    for (std::size_t k = 0; k < face.coedges.size(); ++k)
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
        if (const local_id c = face.coedges[k].curve;
            face.solids[side] != no_id && !data.topology.curves[c].degenerate)
          all[{c, face.solids[side]}].push_back({f, k, face.reversed != (side == 1)});
  }
  std::map<std::array<local_id, 2>, std::vector<passage_at_edge>> repeated;
  for (const auto& [edge_and_solid, passages] : all) {
    if (passages.size() <= 2)
      continue;
    const auto c = static_cast<std::size_t>(edge_and_solid[0]);
    const auto& t = data.topology.curves[c].t;
    const double middle = 0.5 * (t[0] + t[1]);
    gp_Pnt point;
    gp_Vec derivative;
    data.curves[c].D1(middle, point, derivative);
    const vec3 along = normalized(to_vec3(derivative.XYZ()));
    vec3 first{}, second{}; // axes of the angles
    for (const auto& [f, k, flipped] : passages) {
      const surface_frame frame = data.surfaces[f].frame(data.coedges[f][k].at(middle, data.surfaces[f]));
      const vec3 normal = normalized(cross(frame.du, frame.dv));
      const vec3 away = (data.topology.faces[f].coedges[k].reversed ? -1.0 : 1.0) * cross(normal, along);
      if (norm(first) == 0) {
        first = normalized(away);
        second = cross(along, first);
      }
      const vec3 outwards = (flipped ? -1.0 : 1.0) * normal;
      repeated[edge_and_solid].push_back(
          {std::atan2(dot(away, second), dot(away, first)), dot(outwards, cross(along, away)) > 0 ? -1 : 1});
    }
  }
  return repeated;
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
  const auto repeated = repeated_passages(data);
  return std::all_of(repeated.begin(), repeated.end(),
                     [](const auto& passages) { return sectors_are_apart(passages.second); });
}

/// The point of a face's surface nearest another one, and the normal that points out of the solid there.
inline std::array<vec3, 2> foot_and_normal(const TopoDS_Face& face, vec3 point) {
  const face_surface surface(face);
  const auto& box = surface.box();
  const vec2 seed{0.5 * (box[0][0] + box[0][1]), 0.5 * (box[1][0] + box[1][1])};
  const surface_frame frame = surface.frame(surface.project(point, seed));
  return {frame.point,
          (face.Orientation() == TopAbs_REVERSED ? -1.0 : 1.0) * normalized(cross(frame.du, frame.dv))};
}

/// Whether there is material between two faces of a solid where a fuse made them one. Faces that touch within
/// the kernel's own tolerance have nothing between them.
/// \param image what the fuse made of a part of each
/// \param a a face of the solid, with the orientation that it has there
/// \param b the other face
inline bool is_material_between(const TopoDS_Face& image, const TopoDS_Face& a, const TopoDS_Face& b) {
  const face_surface surface(image);
  const auto& box = surface.box();
  const vec3 middle = surface.point({0.5 * (box[0][0] + box[0][1]), 0.5 * (box[1][0] + box[1][1])});
  const auto [at_a, outwards] = foot_and_normal(a, middle);
  return dot(foot_and_normal(b, middle)[0] - at_a, outwards) < -Precision::Confusion();
}

/// The faces of a body as the fuse made them. Those that are both sides of one and the same solid bound
/// nothing any more. Nothing where there is material between those, so that they are the sides of a sheet, or
/// where they look the same way.
/// \param body a solid or a face
/// \param fused what became of all faces
inline std::optional<TopoDS_Shape> body_of_images(const TopoDS_Shape& body, fused_faces& fused) {
  struct image {
    TopoDS_Shape made;
    TopoDS_Face of;
  };
  std::vector<image> images;
  for (TopExp_Explorer faces(body, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    for (const TopoDS_Face& part : fused.parts_of(face))
      images.push_back({part.Composed(face.Orientation()), face});
  }
  TopTools_IndexedMapOfShape different;
  std::vector<std::vector<image>> alike;
  for (const image& one : images) {
    const auto k = static_cast<std::size_t>(different.Add(one.made));
    alike.resize(std::max(alike.size(), k));
    alike[k - 1].push_back(one);
  }
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (const auto& sides : alike)
    if (sides.size() == 1)
      builder.Add(shell, sides[0].made);
    else if (sides.size() > 2 || sides[0].made.Orientation() == sides[1].made.Orientation() ||
             is_material_between(TopoDS::Face(sides[0].made), sides[0].of, sides[1].of))
      return std::nullopt;
  if (body.ShapeType() == TopAbs_FACE)
    return shell;
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

/// The bodies of a model made again of fused faces. Nothing where a sheet would vanish.
inline std::optional<attributed_shape> bodies_of_fused(const attributed_shape& input, const brep& data,
                                                       fused_faces& fused) {
  const BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  attributed_shape result = input;
  for (const TopoDS_Shape& body : bodies_of(data)) {
    const auto made = body_of_images(body, fused);
    if (!made)
      return std::nullopt;
    result.names.inherit(*made, body);
    builder.Add(all, *made);
  }
  inherit_attributes(result.names, input.shape,
                     [&](const TopoDS_Shape& old) { return fused.compound_of(old); });
  result.shape = all;
  return result;
}

/// Replaces a model by what is made of its faces, fused. False, and nothing is changed, where
/// `is_wanted(found)` is false of what would come out, or that is not sound: a solid is gone or open, or
/// passes through itself, or a sheet as thin as the tolerance would vanish.
template <class Wanted>
bool replace_by_fused(attributed_shape& input, brep& data, report& made, wanted what, fused_faces& fused,
                      const Wanted& is_wanted) {
  auto joined = bodies_of_fused(input, data, fused);
  if (!joined)
    return false;
  brep found = brep_builder(joined->shape, joined->names).build();
  report repairs;
  if (!found.faults.empty() && !repair_faults(*joined, found, repairs, what))
    return false;
  if (found.solids.size() != data.solids.size() || !is_wanted(found) || !only_touches_itself(found))
    return false;
  data = std::move(found);
  input = *std::move(joined);
  append(made.warnings, repairs.warnings);
  return true;
}

/// Whether an attempt succeeds; false where OpenCASCADE cannot cope with the shape.
/// \param attempt tells whether it did
template <class Attempt>
bool succeeds(const Attempt& attempt) {
  try {
    return attempt();
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure&) {
    return false;
  }
}

/// Makes faces share what they have in common, where they touch or are within `tolerance` of each other; both
/// sides of a slit as narrow as that vanish. False, and nothing is changed, where there is nothing of the
/// kind, or what would come out is not sound (`replace_by_fused`).
/// Complexity: that of OpenCASCADE's general fuse of all faces, a few milliseconds for each of hundreds, and
/// more for each of thousands.
/// \param input replaced by what the result is made of
/// \param data replaced by the result
/// \param made is told of repairs of slivers that the tolerance leaves
/// \param what solids alone, or faces beside them
/// \param tolerance a length; with 0 faces have to touch within the tolerances of the file
inline bool join_touching_faces(attributed_shape& input, brep& data, report& made, wanted what,
                                double tolerance) {
  return succeeds([&] {
    fused_faces fused;
    return fused.perform(data, tolerance) &&
           replace_by_fused(input, data, made, what, fused,
                            [&](const brep& found) { return entity_counts(found) != entity_counts(data); });
  });
}

/// The same for the edges of a face that lie on each other: what is between them has no width, and no size
/// resolves it. The tolerance is a millionth of the model. Where they cannot be made one the model stays.
/// Complexity: about n log n in the edges of each face; where there are such edges that of OpenCASCADE's
/// general fuse of their bodies.
/// \param input replaced by what the result is made of
/// \param data replaced by the result
/// \param made is told, also where they stay
inline void join_overlapping_edges(attributed_shape& input, brep& data, report& made) {
  const double within = 1e-6 * size_of(input.shape);
  std::vector<local_id> faces;
  if (!succeeds([&] {
        faces = faces_with_overlapping_edges(data, within);
        return !faces.empty();
      }))
    return;
  const std::string what = "edges that lie on each other, such as those of " + face_text(data, faces.front());
  const bool are_joined = succeeds([&] {
    fused_faces fused;
    return fused.perform_with_edges(data, faces, within) &&
           replace_by_fused(input, data, made, wanted::solids, fused, [&](const brep& found) {
             return faces_with_overlapping_edges(found, within).size() < faces.size();
           });
  });
  made.warnings.push_back(what + (are_joined ? ", were made one; numbers of faces and edges are other ones"
                                             : ", could not be made one; elements are flat there"));
}

} // namespace dovetail::occt
