/// @file
/// Solids that touch without sharing topology: their contact faces are made common, so that the mesh
/// conforms.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/geometry/occt_repair.hpp"
#include "dovetail/geometry/occt_topology.hpp"

#include <BOPAlgo_Builder.hxx>

#include <array>
#include <string>
#include <vector>

namespace dovetail::occt {

inline std::string solid_text(const brep& data, std::size_t s) {
  const std::string& name = data.topology.solids[s].name;
  return "solid " + std::to_string(s) + (name.empty() ? "" : " (" + name + ")");
}

/// The first two solids whose bounding boxes meet; equal indices when none do.
inline std::array<std::size_t, 2> first_close_pair(const brep& data) {
  std::vector<Bnd_Box> boxes(data.solids.size());
  for (std::size_t s = 0; s < boxes.size(); ++s)
    BRepBndLib::Add(data.solids[s], boxes[s], false);
  for (std::size_t s = 0; s < boxes.size(); ++s)
    for (std::size_t other = s + 1; other < boxes.size(); ++other)
      if (!boxes[s].IsOut(boxes[other]))
        return {s, other};
  return {0, 0};
}

/// The general fuse of all solids at a fuzzy tolerance: every solid keeps its extent, contacts become shared
/// faces, overlaps become solids of their own. Returns whether a shape was made.
inline bool general_fuse(attributed_shape& input, const brep& data, double fuzzy) {
  BOPAlgo_Builder fuse;
  for (const auto& solid : data.solids)
    fuse.AddArgument(solid);
  fuse.SetNonDestructive(true);
  fuse.SetFuzzyValue(fuzzy);
  fuse.Perform();
  if (fuse.HasErrors())
    return false;
  inherit_attributes(input.names, input.shape, [&](const TopoDS_Shape& old) {
    TopoDS_Compound images;
    const BRep_Builder builder;
    builder.MakeCompound(images);
    for (TopTools_ListIteratorOfListOfShape image(fuse.Modified(old)); image.More(); image.Next())
      builder.Add(images, image.Value());
    return images;
  });
  input.shape = fuse.Shape();
  return true;
}

/// Replaces `data` by the general fuse of its solids when any two of them touch or overlap. Throws
/// `geometry_error` when their common faces cannot be made.
inline void imprint_touching_solids(attributed_shape& input, brep& data, report& made) {
  const auto pair = first_close_pair(data);
  if (pair[0] == pair[1])
    return;
  const double size = size_of(input.shape);
  for (const double fuzzy : {0.0, 1e-6 * size}) {
    attributed_shape trial = input;
    if (!general_fuse(trial, data, fuzzy))
      continue;
    brep fused = brep_builder(trial.shape, trial.names).build();
    if (!fused.faults.empty())
      continue;
    if (fused.faces.size() == data.faces.size() && fused.edges.size() == data.edges.size())
      return; // the solids do not touch, or share their contacts already
    if (fused.solids.size() > data.solids.size())
      made.warnings.push_back("solids overlap; each overlap became a solid of its own, " +
                              std::to_string(fused.solids.size()) + " solids from " +
                              std::to_string(data.solids.size()));
    data = std::move(fused);
    input = std::move(trial);
    return;
  }
  throw geometry_error(input.source + ": " + solid_text(data, pair[0]) + " and " + solid_text(data, pair[1]) +
                       ", or others, touch or overlap and no common boundary could be made; separate them or "
                       "let them share faces in the CAD system");
}

} // namespace dovetail::occt
