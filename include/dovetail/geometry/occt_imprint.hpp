/// @file
/// Solids that touch without sharing topology: their contact faces are made common, so that the mesh
/// conforms.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/geometry/occt_repair.hpp"
#include "dovetail/geometry/occt_topology.hpp"

#include <BOPAlgo_Builder.hxx>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::occt {

inline std::string solid_text(const brep& data, std::size_t s) {
  const std::string& name = data.topology.solids[s].name;
  return "solid " + std::to_string(s) + (name.empty() ? "" : " (" + name + ")");
}

/// The pairs of solids whose bounding boxes meet.
inline std::vector<std::array<std::size_t, 2>> close_pairs(const brep& data) {
  std::vector<Bnd_Box> boxes(data.solids.size());
  for (std::size_t s = 0; s < boxes.size(); ++s)
    BRepBndLib::Add(data.solids[s], boxes[s], false);
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t s = 0; s < boxes.size(); ++s)
    for (std::size_t other = s + 1; other < boxes.size(); ++other)
      if (!boxes[s].IsOut(boxes[other]))
        pairs.push_back({s, other});
  return pairs;
}

/// The general fuse of solids at a fuzzy tolerance: every solid keeps its extent, contacts become shared
/// faces, overlaps become solids of their own. Empty when OCCT fails; else its faults tell whether it is
/// sound.
inline std::optional<brep> general_fuse(attributed_shape& input, const std::vector<TopoDS_Solid>& solids,
                                        double fuzzy) {
  BOPAlgo_Builder fuse;
  for (const auto& solid : solids)
    fuse.AddArgument(solid);
  fuse.SetNonDestructive(true);
  fuse.SetFuzzyValue(fuzzy);
  fuse.Perform();
  if (fuse.HasErrors())
    return std::nullopt;
  inherit_attributes(input.names, input.shape, [&](const TopoDS_Shape& old) {
    TopoDS_Compound images;
    const BRep_Builder builder;
    builder.MakeCompound(images);
    for (TopTools_ListIteratorOfListOfShape image(fuse.Modified(old)); image.More(); image.Next())
      builder.Add(images, image.Value());
    return images;
  });
  input.shape = fuse.Shape();
  return brep_builder(input.shape, input.names).build();
}

/// The first pair of solids that cannot be fused even without the others.
inline std::array<std::size_t, 2> pair_that_fails(const attributed_shape& input, const brep& data,
                                                  const std::vector<std::array<std::size_t, 2>>& pairs) {
  for (const auto& pair : pairs) {
    attributed_shape trial = input;
    const auto fused = general_fuse(trial, {data.solids[pair[0]], data.solids[pair[1]]}, 0);
    if (!fused || !fused->faults.empty())
      return pair;
  }
  return pairs.front();
}

/// Numbers of vertices, curves, faces and faces between two solids.
inline std::array<std::size_t, 4> entity_counts(const brep& data) {
  const auto& faces = data.topology.faces;
  const auto common =
      std::count_if(faces.begin(), faces.end(), [](const auto& face) { return face.solids[1] != no_id; });
  return {data.topology.vertices.size(), data.edges.size(), faces.size(), static_cast<std::size_t>(common)};
}

/// Replaces `data` by the general fuse of its solids when any two of them touch or overlap. Throws
/// `geometry_error` when their common faces cannot be made.
inline void imprint_touching_solids(attributed_shape& input, brep& data, report& made) {
  const auto pairs = close_pairs(data);
  if (pairs.empty())
    return;
  const double size = size_of(input.shape);
  for (const double fuzzy : {0.0, 1e-6 * size}) {
    attributed_shape trial = input;
    std::optional<brep> fused = general_fuse(trial, data.solids, fuzzy);
    if (!fused || !fused->faults.empty())
      continue;
    if (entity_counts(*fused) == entity_counts(data))
      return; // the solids do not touch, or share their contacts already
    if (fused->solids.size() > data.solids.size())
      made.warnings.push_back("solids overlap; each overlap became a solid of its own, " +
                              std::to_string(fused->solids.size()) + " solids from " +
                              std::to_string(data.solids.size()));
    data = *std::move(fused);
    input = std::move(trial);
    return;
  }
  const auto pair = pair_that_fails(input, data, pairs);
  throw geometry_error(input.source + ": " + solid_text(data, pair[0]) + " and " + solid_text(data, pair[1]) +
                       " touch or overlap and no common boundary could be made; separate them or let them "
                       "share faces in the CAD system");
}

} // namespace dovetail::occt
