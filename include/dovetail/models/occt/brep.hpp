/// @file
/// A B-rep ready for queries: the topology as plain data and, beside it, OCCT's geometry of every entity.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/models/occt/coedge.hpp"
#include "dovetail/models/occt/surface.hpp"

#include <GeomAdaptor_Curve.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Solid.hxx>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::occt {

/// Everything an `occt_model` holds.
struct brep {
  TopoDS_Shape shape;                                      ///< as read and healed
  geometry_topology topology;                              ///< entities and how they bound each other
  std::vector<GeomAdaptor_Curve> curves;                   ///< empty for degenerate ones
  std::vector<face_surface> surfaces;                      ///< per face
  std::vector<std::vector<coedge_curve>> coedges;          ///< per face, as `topology.faces[f].coedges`
  std::vector<TopoDS_Edge> edges;                          ///< per curve
  std::vector<TopoDS_Face> faces;                          ///< per face, oriented FORWARD
  std::vector<TopoDS_Solid> solids;                        ///< by their number in the topology
  std::vector<std::pair<TopoDS_Edge, local_id>> collapsed; ///< edges that became a vertex, and that vertex
  std::vector<local_id> crossing;    ///< faces whose boundary crosses itself in the parameter plane
  std::vector<std::string> faults;   ///< what keeps the shape from being meshed, one sentence per entity
  std::vector<std::string> warnings; ///< oddities that do not
};

/// The numbers of the edges of a face, growing, without poles.
inline std::vector<local_id> edges_of_face(const brep& data, std::size_t face) {
  std::vector<local_id> edges;
  for (const auto& coedge : data.topology.faces[face].coedges)
    if (!data.topology.curves[coedge.curve].degenerate)
      edges.push_back(coedge.curve);
  sort_unique(edges);
  return edges;
}

/// Moves the ends of consecutive coedges of a loop together, to their middle.
inline void close_gaps(std::vector<coedge_curve>& loop, const face_surface& surface) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    coedge_curve& next = loop[(i + 1) % loop.size()];
    const vec2 jump = next.start(surface) - loop[i].end(surface);
    loop[i].shift_end(0.5 * jump);
    next.shift_start(-0.5 * jump);
  }
}

} // namespace dovetail::occt
