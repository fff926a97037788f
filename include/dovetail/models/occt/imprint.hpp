/// @file
/// Solids, and faces beside them, that touch without sharing topology: their contacts are made common, so
/// that the mesh conforms.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/models/occt/repair.hpp"
#include "dovetail/models/occt/topology.hpp"

#include <BOPAlgo_Builder.hxx>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::occt {

/// What may touch each other: the solids and, beside them, the faces that are in none.
inline std::vector<TopoDS_Shape> bodies_of(const brep& data) {
  std::vector<TopoDS_Shape> bodies(data.solids.begin(), data.solids.end());
  for (std::size_t f = 0; f < data.faces.size(); ++f)
    if (data.topology.faces[f].solids[0] == no_id)
      bodies.push_back(data.faces[f]);
  return bodies;
}

/// A body of the model, for messages.
inline std::string body_text(const brep& data, std::size_t b) {
  const bool solid = b < data.solids.size();
  const auto& faces = data.topology.faces;
  std::size_t f = 0; // of the face, when it is one
  for (std::size_t left = solid ? 0 : b - data.solids.size() + 1; left > 0; ++f)
    left -= faces[f].solids[0] == no_id ? 1 : 0;
  const std::size_t id = solid ? b : f - 1;
  return entity_name(solid ? "solid" : "face", id, solid ? data.topology.solids[id].name : faces[id].name);
}

/// The pairs of bodies whose bounding boxes meet. Pairs of faces are left out: where these touch they were
/// joined along their edges.
inline std::vector<std::array<std::size_t, 2>> close_pairs(const brep& data,
                                                           const std::vector<TopoDS_Shape>& bodies) {
  std::vector<Bnd_Box> boxes(bodies.size());
  for (std::size_t b = 0; b < boxes.size(); ++b)
    BRepBndLib::Add(bodies[b], boxes[b], false);
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t b = 0; b < data.solids.size(); ++b)
    for (std::size_t other = b + 1; other < boxes.size(); ++other)
      if (!boxes[b].IsOut(boxes[other]))
        pairs.push_back({b, other});
  return pairs;
}

/// Carries out the general fuse of shapes; false when OCCT fails.
/// \param fuse a new one, which then tells what became of each shape
/// \param shapes what is fused: a range of shapes
/// \param fuzzy the tolerance within which shapes touch, in the units of the model
template <class Shapes>
bool perform_fuse(BOPAlgo_Builder& fuse, const Shapes& shapes, double fuzzy) {
  for (const TopoDS_Shape& shape : shapes)
    fuse.AddArgument(shape);
  fuse.SetNonDestructive(true);
  fuse.SetFuzzyValue(fuzzy);
  fuse.Perform();
  return !fuse.HasErrors();
}

/// Carries attributes over to what a fuse made of the faces and solids of a shape.
/// \param names the attributes, of the shape and of what was made
/// \param before the shape
/// \param fuse the fuse, carried out
inline void inherit_from_fuse(attribute_map& names, const TopoDS_Shape& before, BOPAlgo_Builder& fuse) {
  inherit_attributes(names, before, [&](const TopoDS_Shape& old) {
    TopoDS_Compound images;
    const BRep_Builder builder;
    builder.MakeCompound(images);
    for (TopTools_ListIteratorOfListOfShape image(fuse.Modified(old)); image.More(); image.Next())
      builder.Add(images, image.Value());
    return images;
  });
}

/// The sentences on solids that are the same as another one: a fuse makes one of them, whose materials would
/// be lost without a word.
/// \param fuse the fuse, carried out
/// \param bodies what was fused, solids by their numbers
inline std::vector<std::string> said_of_same_solids(BOPAlgo_Builder& fuse,
                                                    const std::vector<TopoDS_Shape>& bodies) {
  std::vector<std::string> said;
  TopTools_IndexedMapOfShape parts;
  std::map<std::vector<int>, std::size_t> first_with;
  for (std::size_t b = 0; b < bodies.size() && bodies[b].ShapeType() == TopAbs_SOLID; ++b) {
    std::vector<int> own;
    for (TopTools_ListIteratorOfListOfShape image(fuse.Modified(bodies[b])); image.More(); image.Next())
      own.push_back(parts.Add(image.Value()));
    if (own.empty())
      own.push_back(parts.Add(bodies[b]));
    sort_all(own);
    const auto [same, is_new] = first_with.try_emplace(std::move(own), b);
    if (!is_new)
      said.push_back("solid " + std::to_string(b) + " of the file is the same as solid " +
                     std::to_string(same->second) + "; they are one solid of the mesh");
  }
  return said;
}

/// The general fuse of bodies at a fuzzy tolerance: every body keeps its extent, contacts become shared
/// faces, overlaps of solids become solids of their own. Empty when OCCT fails; else its faults tell whether
/// it is sound.
/// \param fuzzy the tolerance within which shapes touch, in the units of the model
inline std::optional<brep> general_fuse(attributed_shape& input, const std::vector<TopoDS_Shape>& bodies,
                                        double fuzzy) {
  BOPAlgo_Builder fuse;
  if (!perform_fuse(fuse, bodies, fuzzy))
    return std::nullopt;
  inherit_from_fuse(input.names, input.shape, fuse);
  input.shape = fuse.Shape();
  brep made = brep_builder(input.shape, input.names).build();
  for (std::string& text : said_of_same_solids(fuse, bodies))
    made.warnings.push_back(std::move(text));
  return made;
}

/// The first pair of bodies that cannot be fused even without the others.
/// \param pairs indices of two bodies each
inline std::array<std::size_t, 2> pair_that_fails(const attributed_shape& input,
                                                  const std::vector<TopoDS_Shape>& bodies,
                                                  const std::vector<std::array<std::size_t, 2>>& pairs) {
  for (const auto& pair : pairs) {
    attributed_shape trial = input;
    const auto fused = general_fuse(trial, {bodies[pair[0]], bodies[pair[1]]}, 0);
    if (!fused || !fused->faults.empty())
      return pair;
  }
  return pairs.front();
}

/// Numbers of vertices, curves, passages of curves, faces, faces between two solids, and faces in none.
inline std::array<std::size_t, 6> entity_counts(const brep& data) {
  const auto& faces = data.topology.faces;
  std::size_t passages = 0, common = 0, free = 0;
  for (const auto& face : faces) {
    passages += face.coedges.size();
    common += face.solids[1] != no_id ? 1 : 0;
    free += face.solids[0] == no_id ? 1 : 0;
  }
  return {data.topology.vertices.size(), data.edges.size(), passages, faces.size(), common, free};
}

/// Replaces `data` by the general fuse of some of its bodies when a solid touches or overlaps anything; false
/// when their common boundary cannot be made. Of the fuses as they are and at a small tolerance that with the
/// fewest solids is taken: an overlap that the tolerance removes would be a solid of next to no thickness.
inline bool imprinted(const std::vector<TopoDS_Shape>& bodies, attributed_shape& input, brep& data,
                      report& made) {
  const double size = size_of(input.shape);
  std::optional<brep> best;
  attributed_shape best_input;
  for (const double fuzzy : {0.0, 1e-6 * size}) {
    attributed_shape trial = input;
    std::optional<brep> fused = general_fuse(trial, bodies, fuzzy);
    if (!fused || !fused->faults.empty() || (best && fused->solids.size() >= best->solids.size()))
      continue;
    best = std::move(fused);
    best_input = std::move(trial);
    if (best->solids.size() <= data.solids.size())
      break;
  }
  if (!best)
    return false;
  if (entity_counts(*best) == entity_counts(data))
    return true; // the bodies do not touch, or share their contacts already
  if (best->solids.size() > data.solids.size())
    made.warnings.push_back(
        std::string(bodies.size() > data.solids.size() ? "solids overlap, or are cut by faces beside them"
                                                       : "solids overlap") +
        "; each overlap or part became a solid of its own, " + std::to_string(best->solids.size()) +
        " solids from " + std::to_string(data.solids.size()));
  data = *std::move(best);
  input = std::move(best_input);
  return true;
}

/// Makes the contacts of solids, with each other and with faces beside them, common; those with faces only
/// where that succeeds. Throws `geometry_error` when the common boundary of solids cannot be made.
inline void imprint_touching_bodies(attributed_shape& input, brep& data, report& made) {
  const auto bodies = bodies_of(data);
  if (close_pairs(data, bodies).empty() || imprinted(bodies, input, data, made))
    return;
  const std::vector<TopoDS_Shape> solids(data.solids.begin(), data.solids.end());
  const auto pairs = close_pairs(data, solids);
  if (pairs.empty() || (bodies.size() > solids.size() && imprinted(solids, input, data, made)))
    return;
  const auto pair = pair_that_fails(input, solids, pairs);
  throw geometry_error(input.source + ": " + body_text(data, pair[0]) + " and " + body_text(data, pair[1]) +
                       " touch or overlap and no common boundary could be made; separate them or let them "
                       "share faces in the CAD system");
}

} // namespace dovetail::occt
