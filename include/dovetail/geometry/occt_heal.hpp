/// @file
/// Repair of shapes, in steps of growing force, each taken only when the steps before left faults.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/geometry/occt_imprint.hpp"
#include "dovetail/geometry/occt_repair.hpp"
#include "dovetail/geometry/occt_topology.hpp"

#include <BRepClass3d_SolidClassifier.hxx>

#include <string>
#include <utility>

namespace dovetail::occt {

/// Whether the faces of a solid point inwards, so that it is all of space but its inside.
inline bool is_inside_out(const TopoDS_Solid& solid) {
  BRepClass3d_SolidClassifier classifier(solid);
  classifier.PerformInfinitePoint(1e-7);
  return classifier.State() == TopAbs_IN;
}

/// The same shape as solids with outward faces; what is in no solid is left out.
inline void keep_oriented_solids(attributed_shape& input) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  const TopTools_IndexedMapOfShape solids = sub_shapes(input.shape, TopAbs_SOLID);
  for (int i = 1; i <= solids.Extent(); ++i) {
    TopoDS_Shape solid = solids(i).Oriented(TopAbs_FORWARD);
    if (is_inside_out(TopoDS::Solid(solid)))
      solid.Reverse();
    builder.Add(all, solid);
  }
  input.shape = all;
}

/// A shape without a solid: its faces are sewn, at growing tolerance, until shells close. Throws
/// `geometry_error` naming the first open edge when they do not.
inline void make_solids_of_faces(attributed_shape& input, report& made) {
  const double size = size_of(input.shape);
  std::string open;
  for (const double relative : {1e-7, 1e-6, 1e-5, 1e-4}) {
    attributed_shape trial = input;
    open = sew_faces(trial, relative * size);
    if (!open.empty() || sub_shapes(trial.shape, TopAbs_SOLID).IsEmpty())
      continue;
    made.warnings.push_back("the file has no solid; its faces were sewn at tolerance " +
                            to_text(relative * size));
    input = std::move(trial);
    return;
  }
  throw geometry_error(input.source + ": the file has no solid, and its faces do not enclose one: " + open +
                       "; close the surface in the CAD system");
}

/// Tries one repair on a copy and keeps it when it leaves fewer faults. Returns whether no fault is left.
template <class Repair>
bool try_repair(attributed_shape& input, brep& data, report& made, const std::string& what, Repair&& repair) {
  attributed_shape trial = input;
  try {
    repair(trial);
    if (sub_shapes(trial.shape, TopAbs_SOLID).Extent() < sub_shapes(input.shape, TopAbs_SOLID).Extent())
      return false;
    keep_oriented_solids(trial);
    brep better = brep_builder(trial.shape, trial.names).build();
    if (better.faults.size() >= data.faults.size())
      return false;
    made.warnings.push_back("repaired by " + what + ", for " + data.faults.front());
    data = std::move(better);
    input = std::move(trial);
  } catch (const Standard_Failure&) { // this repair cannot cope with the shape; another one may
    return false;
  }
  return data.faults.empty();
}

/// The `brep` of a shape, healed. A shape without faults is not touched. Throws `geometry_error` naming the
/// first entity that no repair mends.
inline brep healed_brep(attributed_shape input, report& made) {
  if (sub_shapes(input.shape, TopAbs_FACE).IsEmpty())
    throw geometry_error(input.source + ": the file has no faces, so nothing bounds a volume");
  if (sub_shapes(input.shape, TopAbs_SOLID).IsEmpty())
    make_solids_of_faces(input, made);
  else if (TopExp_Explorer(input.shape, TopAbs_FACE, TopAbs_SOLID).More())
    made.warnings.emplace_back("faces that belong to no solid are left out");
  keep_oriented_solids(input);

  brep data = brep_builder(input.shape, input.names).build();
  const double size = size_of(input.shape);
  if (!data.faults.empty()) {
    const std::string first = data.faults.front();
    const std::size_t count = data.faults.size();
    const bool sound =
        try_repair(input, data, made, "fixing faces and wires", [](auto& shape) { fix_shape(shape); }) ||
        try_repair(input, data, made, "removing small edges and faces",
                   [&](auto& shape) { remove_small_entities(shape, 1e-5 * size); }) ||
        try_repair(input, data, made, "sewing", [&](auto& shape) { sew_faces(shape, 1e-6 * size); }) ||
        try_repair(input, data, made, "sewing", [&](auto& shape) { sew_faces(shape, 1e-4 * size); });
    if (!sound)
      throw geometry_error(input.source + ": " + first +
                           (count > 1 ? " (and " + std::to_string(count - 1) + " more faults)" : "") +
                           "; repair the model in the CAD system");
  }
  if (data.solids.size() > 1)
    imprint_touching_solids(input, data, made);
  return data;
}

} // namespace dovetail::occt
