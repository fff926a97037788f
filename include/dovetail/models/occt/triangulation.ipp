/// @file
/// What `occt_triangulation.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/models/occt/brep.hpp"
#include "dovetail/models/occt/repair.hpp"
#include "dovetail/models/occt/triangulation.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>

#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace occt {

/// Joins the triangulations that OCCT makes per face along their common edges.
class triangulation_joiner {
public:
  explicit triangulation_joiner(const occt_model& model) : model_(model) {
    const auto& topology = model.topology();
    for (std::size_t v = 0; v < topology.vertices.size(); ++v)
      add_point(topology.vertices[v].point, {0, static_cast<local_id>(v)});
    curve_points_.resize(topology.curves.size());
  }

  /// `faces`, `edges` and `collapsed` are the model's, meshed.
  surface_mesh join(const std::vector<TopoDS_Face>& faces, const std::vector<TopoDS_Edge>& edges,
                    const std::vector<std::pair<TopoDS_Edge, local_id>>& collapsed) {
    collapsed_ = &collapsed;
    for (std::size_t f = 0; f < faces.size(); ++f)
      add_face(static_cast<local_id>(f), faces[f], edges);
    return std::move(result_);
  }

private:
  local_id add_point(vec3 p, host on) {
    result_.mesh.points.push_back(p);
    result_.vertex_hosts.push_back(on);
    return static_cast<local_id>(result_.mesh.points.size() - 1);
  }

  void add_face(local_id f, const TopoDS_Face& face, const std::vector<TopoDS_Edge>& edges) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
    const auto& item = model_.topology().faces[f];
    const std::string text = "face " + std::to_string(f) + (item.name.empty() ? "" : " (" + item.name + ")");
    if (mesh.IsNull() || mesh->NbTriangles() == 0 || !mesh->HasUVNodes())
      throw geometry_error(text + " cannot be triangulated; repair it in the CAD system");

    std::vector<local_id> ids(static_cast<std::size_t>(mesh->NbNodes()), no_id);
    for (const auto& coedge : item.coedges) {
      const auto c = static_cast<std::size_t>(coedge.curve);
      const TopoDS_Shape oriented = edges[c].Oriented(coedge.reversed ? TopAbs_REVERSED : TopAbs_FORWARD);
      const Handle(Poly_PolygonOnTriangulation) polygon =
          BRep_Tool::PolygonOnTriangulation(TopoDS::Edge(oriented), mesh, location);
      if (polygon.IsNull() || (polygon->Parameters().IsNull() && !model_.topology().curves[c].degenerate))
        throw geometry_error(text + ": edge " + std::to_string(c) + " was not triangulated");
      name_curve_nodes(coedge.curve, *polygon, ids);
    }
    name_collapsed_nodes(mesh, location, ids);
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (ids[i] == no_id)
        ids[i] = add_point(
            to_vec3(mesh->Node(static_cast<int>(i + 1)).Transformed(location.Transformation())), {2, f});
    add_triangles(f, *mesh, ids);
  }

  /// Gives the triangulation nodes along a curve the ids of the curve's points, made when first seen.
  void name_curve_nodes(local_id c, const Poly_PolygonOnTriangulation& polygon, std::vector<local_id>& ids) {
    const auto& curve = model_.topology().curves[c];
    std::vector<local_id>& points = curve_points_[c];
    const int count = polygon.NbNodes();
    if (points.empty()) {
      points.assign(static_cast<std::size_t>(count), curve.vertices[0]);
      points.back() = curve.vertices[1];
      std::vector<double> t(points.size(), curve.t[0]);
      t.back() = curve.t[1];
      for (int i = 1; !curve.degenerate && i + 1 < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        t[k] = polygon.Parameters()->Value(i + 1);
        points[k] = add_point(model_.curve_point(c, t[k]), {1, c});
      }
      for (std::size_t k = 0; !curve.degenerate && k + 1 < points.size(); ++k)
        result_.curve_edges.push_back({{points[k], points[k + 1]}, c, {t[k], t[k + 1]}});
    }
    if (points.size() != static_cast<std::size_t>(count) && !curve.degenerate)
      throw geometry_error("edge " + std::to_string(c) + " was triangulated differently on its two faces");
    for (int i = 0; i < count; ++i)
      ids[polygon.Node(i + 1) - 1] = curve.degenerate ? curve.vertices[0] : points[i];
  }

  void name_collapsed_nodes(const Handle(Poly_Triangulation) & mesh, const TopLoc_Location& location,
                            std::vector<local_id>& ids) const {
    for (const auto& [edge, vertex] : *collapsed_) {
      for (const TopAbs_Orientation side : {TopAbs_FORWARD, TopAbs_REVERSED}) {
        const Handle(Poly_PolygonOnTriangulation) polygon =
            BRep_Tool::PolygonOnTriangulation(TopoDS::Edge(edge.Oriented(side)), mesh, location);
        for (int i = 1; !polygon.IsNull() && i <= polygon->NbNodes(); ++i)
          ids[polygon->Node(i) - 1] = vertex;
      }
    }
  }

  void add_triangles(local_id f, const Poly_Triangulation& mesh, const std::vector<local_id>& ids) {
    const bool reversed = model_.topology().faces[f].reversed;
    for (int i = 1; i <= mesh.NbTriangles(); ++i) {
      std::array<int, 3> node{};
      mesh.Triangle(i).Get(node[0], node[1], node[2]);
      if (reversed)
        std::swap(node[1], node[2]);
      simplex<2> triangle{};
      std::array<vec2, 3> uv{};
      for (std::size_t k = 0; k < 3; ++k) {
        triangle[k] = ids[node[k] - 1];
        uv[k] = {mesh.UVNode(node[k]).X(), mesh.UVNode(node[k]).Y()};
      }
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
        continue; // flat at a pole
      result_.mesh.elements.push_back(triangle);
      result_.mesh.tags.push_back(f);
      result_.corner_uv.push_back(uv);
    }
  }

  const occt_model& model_;
  surface_mesh result_;
  std::vector<std::vector<local_id>> curve_points_;
  const std::vector<std::pair<TopoDS_Edge, local_id>>* collapsed_ = nullptr; ///< set while joining
};

} // namespace occt

DOVETAIL_INLINE_OCCT surface_mesh occt_triangulation(const occt_model& model,
                                                     triangulation_parameters parameters) {
  const occt::silenced quiet;
  const double deflection =
      parameters.deflection > 0 ? parameters.deflection : 1e-3 * model.bounds().diagonal();
  return occt::guarded("triangulation", [&] {
    // A copy, since OCCT stores triangulations in the shape and reuses those it finds there.
    BRepBuilderAPI_Copy copy(model.shape(), false, false);
    BRepMesh_IncrementalMesh mesher(copy.Shape(), deflection, false, parameters.angle, false);
    std::vector<TopoDS_Face> faces;
    for (const auto& face : model.data().faces)
      faces.push_back(TopoDS::Face(copy.ModifiedShape(face)));
    std::vector<TopoDS_Edge> edges;
    for (const auto& edge : model.data().edges)
      edges.push_back(TopoDS::Edge(copy.ModifiedShape(edge)));
    std::vector<std::pair<TopoDS_Edge, local_id>> collapsed;
    for (const auto& [edge, vertex] : model.data().collapsed)
      collapsed.emplace_back(TopoDS::Edge(copy.ModifiedShape(edge)), vertex);
    return occt::triangulation_joiner(model).join(faces, edges, collapsed);
  });
}

DOVETAIL_INLINE_OCCT std::vector<double> occt_face_areas(const occt_model& model) {
  std::vector<double> areas;
  for (const auto& face : model.data().faces) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties);
    areas.push_back(properties.Mass());
  }
  return areas;
}

DOVETAIL_INLINE_OCCT std::vector<double> occt_solid_volumes(const occt_model& model) {
  std::vector<double> volumes;
  for (const auto& solid : model.data().solids)
    volumes.push_back(occt::volume_of(solid, 1e-9));
  return volumes;
}

} // namespace dovetail
