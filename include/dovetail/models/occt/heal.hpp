/// @file
/// Repair of shapes, in steps of growing force, each taken only when the steps before left faults.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/models/occt/open_shells.hpp"
#include "dovetail/models/occt/options.hpp"
#include "dovetail/models/occt/repair.hpp"
#include "dovetail/models/occt/spheres.hpp"
#include "dovetail/models/occt/topology.hpp"

#include <BRepClass3d_SolidClassifier.hxx>
#include <ShapeBuild_ReShape.hxx>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::occt {

/// Whether the faces of a solid point inwards, so that it is all of space but its inside.
inline bool is_inside_out(const TopoDS_Solid& solid) {
  BRepClass3d_SolidClassifier classifier(solid);
  classifier.PerformInfinitePoint(1e-7);
  return classifier.State() == TopAbs_IN;
}

/// The same shape as solids with outward faces; what is in no solid is left out, unless faces are wanted.
inline void keep_oriented_solids(attributed_shape& input, wanted what) {
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
  for (TopExp_Explorer faces(input.shape, TopAbs_FACE, TopAbs_SOLID); what == wanted::faces && faces.More();
       faces.Next())
    builder.Add(all, faces.Current());
  input.shape = all;
}

/// Leaves out solids that have the faces of another one: two of one shell.
inline void drop_repeated_solids(attributed_shape& input, report& made) {
  const TopTools_IndexedMapOfShape faces = sub_shapes(input.shape, TopAbs_FACE);
  const TopTools_IndexedMapOfShape solids = sub_shapes(input.shape, TopAbs_SOLID);
  const Handle(ShapeBuild_ReShape) context = new ShapeBuild_ReShape;
  std::map<std::vector<int>, int> seen;
  for (int i = 1; i <= solids.Extent(); ++i) {
    std::vector<int> own;
    for (TopExp_Explorer each(solids(i), TopAbs_FACE); each.More(); each.Next())
      own.push_back(faces.FindIndex(each.Current()));
    sort_all(own);
    const auto [first, is_new] = seen.try_emplace(std::move(own), i - 1);
    if (is_new)
      continue;
    context->Remove(solids(i));
    made.warnings.push_back("solid " + std::to_string(i - 1) + " has the faces of solid " +
                            std::to_string(first->second) + " and is left out");
  }
  if (static_cast<int>(seen.size()) < solids.Extent())
    input.shape = context->Apply(input.shape);
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

/// A shape without a solid, of which all faces are wanted: solids where they enclose any, else shells.
inline void make_solids_or_shells(attributed_shape& input, report& made) {
  if (has_free(input.shape, TopAbs_EDGE, TopAbs_FACE))
    imprint_free_edges(input);
  try {
    make_solids_of_faces(input, made);
  } catch (const geometry_error&) { // they enclose nothing
    make_shells(input, 1e-6 * size_of(input.shape));
  }
}

/// What is wrong first: a fault, else a face whose boundary crosses itself.
inline std::string first_trouble(const brep& data) {
  return data.faults.empty() ? face_text(data, data.crossing.front()) +
                                   ", whose boundary crosses itself in the parameter plane"
                             : data.faults.front();
}

/// Tries one repair on a copy and keeps it when it leaves fewer faults, or as few and fewer faces whose
/// boundary crosses itself. Returns whether no fault is left.
template <class Repair>
bool try_repair(attributed_shape& input, brep& data, report& made, wanted entities, const std::string& what,
                Repair&& repair) {
  attributed_shape trial = input;
  try {
    repair(trial);
    if (sub_shapes(trial.shape, TopAbs_SOLID).Extent() < sub_shapes(input.shape, TopAbs_SOLID).Extent())
      return false;
    keep_oriented_solids(trial, entities);
    brep better = brep_builder(trial.shape, trial.names).build();
    const auto troubles = [](const brep& of) { return std::pair(of.faults.size(), of.crossing.size()); };
    if (troubles(better) >= troubles(data))
      return false;
    made.warnings.push_back("repaired by " + what + ", for " + first_trouble(data));
    data = std::move(better);
    input = std::move(trial);
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure&) { // this repair cannot cope with the shape; another one may
    return false;
  }
  return data.faults.empty();
}

/// Repairs of growing force until no fault is left. Returns whether that was reached.
inline bool repair_faults(attributed_shape& input, brep& data, report& made, wanted what) {
  const double size = size_of(input.shape);
  const auto try_one = [&](const char* name, const auto& repair) {
    return try_repair(input, data, made, what, name, repair);
  };
  const auto sew = [&](double tolerance) {
    return [=](auto& shape) {
      if (sub_shapes(shape.shape, TopAbs_SOLID).IsEmpty())
        sew_shells(shape, tolerance);
      else
        sew_faces(shape, tolerance);
    };
  };
  return try_one("fixing faces and wires", [](auto& shape) { fix_shape(shape); }) ||
         try_one("removing small edges and faces",
                 [&](auto& shape) { remove_small_entities(shape, 1e-5 * size); }) ||
         try_one("sewing", sew(1e-6 * size)) || try_one("sewing", sew(1e-4 * size));
}

/// Faces whose solids are open or overlap, as shells. Returns whether no fault is left then.
inline bool give_up_solids(attributed_shape& input, brep& data, report& made) {
  attributed_shape shells = input;
  make_shells(shells, 1e-6 * size_of(input.shape));
  brep found = brep_builder(shells.shape, shells.names).build();
  if (!found.faults.empty())
    return false;
  made.warnings.push_back("its faces are shells that bound no solid, for " + data.faults.front());
  data = std::move(found);
  input = std::move(shells);
  return true;
}

/// The `brep` of a shape, repaired. A shape without faults is not touched. Throws `geometry_error` naming the
/// first entity that no repair mends.
/// \param input replaced by what the result is made of
inline brep repaired_brep(attributed_shape& input, report& made, wanted what = wanted::solids) {
  if (sub_shapes(input.shape, TopAbs_FACE).IsEmpty())
    throw geometry_error(input.source + ": the file has no faces, so nothing bounds a volume");
  if (!sub_shapes(input.shape, TopAbs_SOLID).IsEmpty()) {
    if (what == wanted::solids && has_free(input.shape, TopAbs_FACE, TopAbs_SOLID))
      made.warnings.emplace_back("faces that belong to no solid are left out");
  } else if (what == wanted::solids) {
    make_solids_of_faces(input, made);
  } else {
    make_solids_or_shells(input, made);
  }
  drop_repeated_solids(input, made);
  turn_spheres(input, made);
  keep_oriented_solids(input, what);

  brep data = brep_builder(input.shape, input.names).build();
  if (!data.faults.empty()) {
    const std::string first = data.faults.front();
    const std::size_t count = data.faults.size();
    if (!repair_faults(input, data, made, what) &&
        !(what == wanted::faces && give_up_solids(input, data, made)))
      throw geometry_error(input.source + ": " + first +
                           (count > 1 ? " (and " + std::to_string(count - 1) + " more faults)" : "") +
                           "; repair the model in the CAD system");
  }
  if (!data.crossing.empty())
    try_repair(input, data, made, what, "fixing single faces", [&](auto& shape) {
      std::vector<TopoDS_Face> faces;
      for (const local_id f : data.crossing)
        faces.push_back(data.faces[f]);
      fix_faces(shape, faces);
    });
  return data;
}

} // namespace dovetail::occt
