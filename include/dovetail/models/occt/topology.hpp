/// @file
/// From solids of a B-rep to `geometry_topology`, with the handles that queries need and the faults found.
#pragma once

#include "dovetail/geometry/concepts.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/models/occt/brep.hpp"
#include "dovetail/models/occt/loops.hpp"
#include "dovetail/models/occt/small_edges.hpp"

#include <Geom_Curve.hxx>
#include <TopTools_MapOfShape.hxx>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace dovetail::occt {

/// A face's number and name, for messages.
inline std::string face_text(const brep& data, local_id f) {
  return entity_name("face", f, data.topology.faces[f].name);
}

/// Builds a `brep` from all solids of a shape and the faces beside them. The order of entities is that of
/// OCCT's explorer.
class brep_builder {
public:
  brep_builder(const TopoDS_Shape& shape, const attribute_map& names) : names_(names), size_(size_of(shape)) {
    result_.shape = shape;
  }

  /// The whole model.
  brep build() {
    const TopTools_IndexedMapOfShape solids = sub_shapes(result_.shape, TopAbs_SOLID);
    for (int s = 1; s <= solids.Extent(); ++s)
      add_solid(TopoDS::Solid(solids(s)));
    for (TopExp_Explorer faces(result_.shape, TopAbs_FACE, TopAbs_SOLID); faces.More(); faces.Next())
      if (!face_ids_.Contains(faces.Current()))
        add_face(TopoDS::Face(faces.Current()), no_id);
    find_rims();
    for (std::size_t f = 0; f < result_.faces.size(); ++f)
      add_loops(static_cast<local_id>(f));
    if (result_.faults.empty())
      small_edge_collapse(result_, 1e-6 * size_).run();
    for (std::size_t s = 0; s < result_.solids.size(); ++s)
      check_closed(static_cast<local_id>(s));
    measure_tolerances();
    warn_of_gaps();
    return std::move(result_);
  }

private:
  std::string face_text(local_id f) const { return occt::face_text(result_, f); }
  std::string curve_text(local_id c) const {
    const auto& curve = result_.topology.curves[c];
    const vec3 a = result_.topology.vertices[curve.vertices[0]].point;
    const vec3 b = result_.topology.vertices[curve.vertices[1]].point;
    return "edge " + std::to_string(c) + " from " + to_text(a) + " to " + to_text(b);
  }

  void add_solid(const TopoDS_Solid& solid) {
    const auto s = static_cast<local_id>(result_.solids.size());
    result_.solids.push_back(solid);
    const attributes* found = names_.find(solid);
    result_.topology.solids.push_back({found ? found->name : std::string{}});
    for (TopExp_Explorer faces(solid, TopAbs_FACE); faces.More(); faces.Next())
      add_face(TopoDS::Face(faces.Current()), s);
  }

  /// The face's orientation in its first solid is the one it gets; a second solid must use the other one.
  void add_face(const TopoDS_Face& face, local_id solid) {
    if (face.Orientation() != TopAbs_FORWARD && face.Orientation() != TopAbs_REVERSED)
      return; // a face inside the solid bounds nothing
    const bool reversed = face.Orientation() == TopAbs_REVERSED;
    const int known = face_ids_.FindIndex(face);
    if (known == 0) {
      face_ids_.Add(face);
      geometry_topology::face item;
      item.reversed = reversed;
      item.solids[0] = solid;
      item.tolerance = BRep_Tool::Tolerance(face);
      if (const attributes* found = names_.find(face)) {
        item.name = found->name;
        item.group = found->group();
      }
      result_.topology.faces.push_back(item);
      result_.faces.push_back(TopoDS::Face(face.Oriented(TopAbs_FORWARD)));
      return;
    }
    auto& item = result_.topology.faces[known - 1];
    if (item.reversed == reversed || item.solids[1] != no_id)
      result_.faults.push_back(face_text(known - 1) + " is used by several solids on the same side");
    else
      item.solids[1] = solid;
  }

  /// An edge inside a face that bounds another one, or is inside another one, is where two solids touch along
  /// a line: both have it.
  void find_rims() {
    TopTools_MapOfShape inner;
    for (const TopoDS_Face& face : result_.faces)
      for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
        const TopoDS_Shape& edge = edges.Current();
        const bool bounds = edge.Orientation() == TopAbs_FORWARD || edge.Orientation() == TopAbs_REVERSED;
        if (bounds || !inner.Add(edge))
          rims_.Add(edge);
      }
  }

  void add_loops(local_id f) {
    const auto index = static_cast<std::size_t>(f);
    face_surface& surface = result_.surfaces.emplace_back(result_.faces[index]);
    const bool encloses = result_.topology.faces[index].solids[0] != no_id;
    const auto is_loop = [&](const TopoDS_Edge& inner) { return !encloses || rims_.Contains(inner); };
    const face_loops made = loop_builder(result_.faces[index], surface, size_, is_loop).build();
    for (const auto& fault : made.faults)
      result_.faults.push_back(face_text(f) + " " + fault);
    if (made.faults.empty())
      surface.set_box(box_of_loops(made, surface));
    if (!made.note.empty())
      result_.warnings.push_back(face_text(f) + ": " + made.note);
    if (made.crosses_itself)
      result_.crossing.push_back(f);
    auto& item = result_.topology.faces[index];
    auto& curves = result_.coedges.emplace_back();
    for (const auto& loop : made.loops) {
      auto& ids = item.loops.emplace_back();
      std::vector<coedge_curve> loop_curves;
      for (const auto& passage : loop) {
        ids.push_back({curve_id(passage.edge, passage.curve), passage.curve.reversed()});
        loop_curves.push_back(passage.curve);
      }
      if (made.faults.empty())
        close_gaps(loop_curves, surface);
      item.coedges.insert(item.coedges.end(), ids.begin(), ids.end());
      curves.insert(curves.end(), loop_curves.begin(), loop_curves.end());
    }
  }

  local_id curve_id(const TopoDS_Edge& edge, const coedge_curve& passage) {
    const int known = edge_ids_.FindIndex(edge);
    if (known != 0)
      return known - 1;
    edge_ids_.Add(edge);
    geometry_topology::curve item;
    item.t = passage.edge_range();
    item.tolerance = BRep_Tool::Tolerance(edge);
    GeomAdaptor_Curve in_space;
    double t0 = 0, t1 = 0;
    const Handle(Geom_Curve) curve =
        BRep_Tool::Degenerated(edge) ? Handle(Geom_Curve)() : BRep_Tool::Curve(edge, t0, t1);
    item.degenerate = curve.IsNull();
    if (!curve.IsNull())
      in_space.Load(curve);
    TopoDS_Vertex first, last;
    TopExp::Vertices(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)), first, last);
    item.vertices = {vertex_id(first, in_space, item.t[0]), vertex_id(last, in_space, item.t[1])};
    result_.topology.curves.push_back(item);
    result_.edges.push_back(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)));
    result_.curves.push_back(in_space);
    const auto id = static_cast<local_id>(result_.edges.size() - 1);
    if (item.degenerate && item.vertices[0] != item.vertices[1])
      result_.faults.push_back(curve_text(id) + " has no curve in space");
    return id;
  }

  /// An edge without a vertex (a closed curve) gets one where its curve begins.
  local_id vertex_id(const TopoDS_Vertex& vertex, const GeomAdaptor_Curve& curve, double t) {
    auto& vertices = result_.topology.vertices;
    if (vertex.IsNull()) {
      vertices.push_back({to_vec3(curve.Value(t)), 0});
      return static_cast<local_id>(vertices.size() - 1);
    }
    const auto [at, added] = vertex_ids_.try_emplace(vertex_map_.Add(vertex), vertices.size());
    if (added)
      vertices.push_back({to_vec3(BRep_Tool::Pnt(vertex)), BRep_Tool::Tolerance(vertex)});
    return static_cast<local_id>(at->second);
  }

  /// A solid is closed when its faces pass every edge equally often in both directions.
  void check_closed(local_id solid) {
    std::vector<int> passages(result_.edges.size(), 0), balance(result_.edges.size(), 0);
    for (const auto& face : result_.topology.faces) {
      if (face.solids[0] != solid && face.solids[1] != solid)
        continue;
      const bool flipped = face.reversed != (face.solids[0] != solid);
      for (const auto& coedge : face.coedges) {
        const auto c = static_cast<std::size_t>(coedge.curve);
        passages[c] += 1;
        balance[c] += coedge.reversed != flipped ? -1 : 1;
      }
    }
    for (std::size_t c = 0; c < passages.size(); ++c) {
      if (result_.topology.curves[c].degenerate || passages[c] == 0)
        continue;
      const std::string text = curve_text(static_cast<local_id>(c));
      if (passages[c] % 2 != 0)
        result_.faults.push_back("solid " + std::to_string(solid) + " is open at " + text);
      else if (balance[c] != 0)
        result_.faults.push_back("solid " + std::to_string(solid) + " has faces of opposite orientation at " +
                                 text);
      else if (passages[c] > 2)
        result_.warnings.push_back("solid " + std::to_string(solid) + " touches itself along " + text);
    }
  }

  /// Raises curve tolerances to the distances measured between each curve and its faces. A distance that
  /// is no tolerance any more is a fault: the curve belongs somewhere else.
  void measure_tolerances() {
    measured_.assign(result_.edges.size(), 0);
    for (std::size_t f = 0; f < result_.faces.size(); ++f) {
      for (std::size_t k = 0; k < result_.coedges[f].size(); ++k) {
        const local_id c = result_.topology.faces[f].coedges[k].curve;
        auto& item = result_.topology.curves[c];
        const double deviation = result_.coedges[f][k].deviation(result_.surfaces[f]);
        measured_[c] = std::max(measured_[c], deviation);
        item.tolerance = std::max(item.tolerance, deviation);
        if (deviation > largest_deviation * size_)
          result_.faults.push_back(face_text(static_cast<local_id>(f)) + " is " + to_text(deviation) +
                                   " away from its " + curve_text(c));
      }
    }
  }

  /// Names the curves that are far from their faces, up to a few.
  void warn_of_gaps() {
    constexpr std::size_t named = 5;
    std::size_t count = 0;
    for (std::size_t c = 0; c < measured_.size(); ++c)
      if (measured_[c] > notable_deviation * size_ && ++count <= named)
        result_.warnings.push_back(curve_text(static_cast<local_id>(c)) + " is up to " +
                                   to_text(measured_[c]) + " away from its faces");
    if (count > named)
      result_.warnings.push_back(std::to_string(count - named) + " more edges are away from their faces");
  }

  static constexpr double notable_deviation = 1e-4; // of the model's diagonal
  static constexpr double largest_deviation = 0.01; // likewise
  const attribute_map& names_;
  double size_; ///< diagonal of the shape
  brep result_;
  TopTools_IndexedMapOfShape face_ids_, edge_ids_, vertex_map_;
  TopTools_MapOfShape rims_; ///< edges that bound a face, or are inside of two
  std::map<int, std::size_t> vertex_ids_;
  std::vector<double> measured_; ///< per curve: the largest distance to its faces
};

} // namespace dovetail::occt
