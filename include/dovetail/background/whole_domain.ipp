/// @file
/// What `whole_domain.hpp` declares.
#pragma once

#include "dovetail/background/surface_faces.hpp"
#include "dovetail/background/whole_domain.hpp"
#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/background_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::background {

DOVETAIL_INLINE std::vector<std::vector<vec3>> lines_on_curves(const surface_mesh& surface) {
  std::vector<std::vector<vec3>> lines;
  local_id curve = no_id;
  for (const auto& edge : surface.curve_edges) { // those of a curve follow each other, in its direction
    if (edge.curve != curve)
      lines.push_back({surface.mesh.points[edge.vertices[0]]});
    curve = edge.curve;
    lines.back().push_back(surface.mesh.points[edge.vertices[1]]);
  }
  return lines;
}

namespace detail {

/// Finds the place of points on a surface mesh.
class surface_locator {
public:
  struct place {
    local_id triangle = no_id;
    vec2 uv; ///< on the triangle's face
  };

  explicit surface_locator(const surface_mesh& surface)
      : surface_(surface), triangles_(boxes_of(surface.mesh.elements)), edges_(edge_boxes()) {}

  /// The nearest triangle, of one face only unless `face` is no_id.
  place nearest(vec3 p, local_id face) const {
    double best = std::numeric_limits<double>::infinity();
    place found;
    triangles_.for_each_near(
        p, [&](const box3& box, std::size_t) { return distance_squared(box, p) < best; },
        [&](local_id t) {
          const auto i = static_cast<std::size_t>(t);
          if (face != no_id && surface_.mesh.tags[i] != face)
            return;
          const auto& [a, b, c] = surface_.mesh.elements[i];
          const auto weights = nearest_on_triangle(point(a), point(b), point(c), p);
          const vec3 off = weights[0] * point(a) + weights[1] * point(b) + weights[2] * point(c) - p;
          if (const double d = dot(off, off); d < best) {
            best = d;
            const auto& uv = surface_.corner_uv[i];
            found = {t, weights[0] * uv[0] + weights[1] * uv[1] + weights[2] * uv[2]};
          }
        });
    return found;
  }

  /// Calls `visit(curve, t)` for the curve edges within a distance.
  template <class Visit>
  void curves_at(vec3 p, double reach, Visit&& visit) const {
    edges_.for_each([&](const box3& box, std::size_t) { return distance_squared(box, p) <= reach * reach; },
                    [&](local_id e) {
                      const auto& edge = surface_.curve_edges[e];
                      const vec3 a = point(edge.vertices[0]), b = point(edge.vertices[1]);
                      const auto weights = nearest_on_segment(a, b, p);
                      if (norm(weights[0] * a + weights[1] * b - p) <= reach)
                        visit(edge.curve, weights[0] * edge.t[0] + weights[1] * edge.t[1]);
                    });
  }

private:
  vec3 point(local_id v) const { return surface_.mesh.points[v]; }

  template <class Simplices>
  std::vector<box3> boxes_of(const Simplices& simplices) const {
    std::vector<box3> boxes;
    for (const auto& vertices : simplices) {
      box3& box = boxes.emplace_back();
      for (const local_id v : vertices)
        box.include(point(v));
    }
    return boxes;
  }
  std::vector<box3> edge_boxes() const {
    std::vector<std::array<local_id, 2>> edges;
    for (const auto& edge : surface_.curve_edges)
      edges.push_back(edge.vertices);
    return boxes_of(edges);
  }

  const surface_mesh& surface_;
  box_tree triangles_;
  box_tree edges_;
};

/// One use of `background_of_whole_domain`.
class boundary_hosts {
public:
  boundary_hosts(const any_geometry& model, const surface_mesh& reference, const simplicial_mesh<3>& volume)
      : model_(model), topology_(model.topology()), reference_(reference), volume_(volume),
        locate_(reference), reach_(1e-7 * model.bounds().diagonal()), hull_(hull_of(volume)) {}

  background_mesh run() {
    find_curve_points();
    number_points();
    name_faces();
    make_triangles();
    make_volume();
    return std::move(made_);
  }

private:
  static std::vector<simplex<2>> hull_of(const simplicial_mesh<3>& volume) {
    const auto sides = build_sides(volume);
    std::vector<simplex<2>> hull;
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (sides.is_boundary(static_cast<local_id>(s)))
        hull.push_back(sides.vertices[s]);
    return hull;
  }
  static std::array<local_id, 2> edge_of(const simplex<2>& t, std::size_t k) {
    return sorted_vertices(simplex<1>{t[k], t[(k + 1) % 3]});
  }

  std::string name_of(local_id curve) const {
    return entity_name("curve", curve, topology_.curves[curve].name);
  }

  /// The points of the hull on each curve, from its first vertex to its last, joined by edges.
  void find_curve_points() {
    std::vector<local_id> of_vertex(topology_.vertices.size(), no_id);
    std::vector<std::vector<std::pair<double, local_id>>> on_curve(topology_.curves.size());
    std::set<local_id> points;
    for (const auto& t : hull_)
      points.insert(t.begin(), t.end());
    for (const local_id v : points) {
      const vec3 p = volume_.points[v];
      bool is_vertex = false;
      for (std::size_t i = 0; i < topology_.vertices.size(); ++i)
        if (distance(topology_.vertices[i].point, p) <= reach_) {
          of_vertex[i] = v;
          is_vertex = true;
        }
      if (!is_vertex)
        locate_.curves_at(p, reach_, [&](local_id curve, double t) {
          auto& found = on_curve[curve];
          if (found.empty() || found.back().second != v) // else two of its edges meet here
            found.emplace_back(t, v);
        });
    }
    curves_.t.resize(topology_.curves.size());
    chains_.resize(topology_.curves.size());
    for (std::size_t c = 0; c < topology_.curves.size(); ++c) {
      const auto& curve = topology_.curves[c];
      curves_.t[c] = {curve.t[0], curve.t[1]};
      if (curve.degenerate)
        continue;
      auto& found = on_curve[c];
      found.emplace_back(curve.t[0], of_vertex[curve.vertices[0]]);
      found.emplace_back(curve.t[1], of_vertex[curve.vertices[1]]);
      std::sort(found.begin(), found.end());
      curves_.t[c].clear();
      for (const auto& [t, v] : found) {
        curves_.t[c].push_back(t);
        chains_[c].push_back(v);
      }
    }
    require_lines();
    curves_.number(topology_);
  }

  void require_lines() {
    std::set<std::array<local_id, 2>> edges;
    for (const auto& t : hull_)
      for (std::size_t k = 0; k < 3; ++k)
        edges.insert(edge_of(t, k));
    for (std::size_t c = 0; c < chains_.size(); ++c)
      for (std::size_t i = 0; i + 1 < chains_[c].size(); ++i) {
        const simplex<1> edge = sorted_vertices(simplex<1>{chains_[c][i], chains_[c][i + 1]});
        if (edge[0] == no_id || !edges.contains(edge))
          throw mesher_error("the background mesher did not keep " + name_of(static_cast<local_id>(c)) +
                             " as a line; use one that keeps the boundary, or a finer background");
        on_lines_.insert(edge);
      }
  }

  /// Points as in any coarse surface: vertices, curves, the rest of the hull; then those inside.
  void number_points() {
    number_.assign(volume_.points.size(), no_id);
    surface_mesh& surface = made_.surface;
    surface.mesh.points.resize(curves_.count);
    surface.vertex_hosts.resize(curves_.count);
    for (std::size_t v = 0; v < topology_.vertices.size(); ++v) {
      surface.mesh.points[v] = topology_.vertices[v].point;
      surface.vertex_hosts[v] = {0, static_cast<local_id>(v)};
    }
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      const auto curve = static_cast<local_id>(c);
      for (std::size_t i = 0; i < chains_[c].size(); ++i) {
        const local_id id = curves_.point_id(topology_, curve, i);
        number_[chains_[c][i]] = id;
        if (i == 0)
          continue;
        const double t = curves_.t[c][i];
        if (i + 1 < chains_[c].size()) {
          surface.mesh.points[id] = model_.curve_point(curve, t);
          surface.vertex_hosts[id] = {1, curve};
        }
        surface.curve_edges.push_back(
            {{curves_.point_id(topology_, curve, i - 1), id}, curve, {curves_.t[c][i - 1], t}});
      }
    }
  }

  /// Parts of the hull between the lines lie on one face each: the one that most of their triangles are at.
  void name_faces() {
    std::map<std::array<local_id, 2>, std::vector<local_id>> triangles_at;
    for (std::size_t t = 0; t < hull_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto edge = edge_of(hull_[t], k); !on_lines_.contains(edge))
          triangles_at[edge].push_back(static_cast<local_id>(t));
    face_.assign(hull_.size(), no_id);
    std::vector<char> seen(hull_.size(), 0);
    for (std::size_t first = 0; first < hull_.size(); ++first) {
      if (seen[first])
        continue;
      std::vector<local_id> part{static_cast<local_id>(first)};
      seen[first] = 1;
      std::map<local_id, std::size_t> votes;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const simplex<2> t = hull_[part[i]];
        ++votes[reference_.mesh.tags[locate_.nearest(center(t), no_id).triangle]];
        for (std::size_t k = 0; k < 3; ++k)
          for (const local_id next : triangles_at[edge_of(t, k)])
            if (!seen[next]) {
              seen[next] = 1;
              part.push_back(next);
            }
      }
      const auto most = std::max_element(votes.begin(), votes.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      for (const local_id t : part)
        face_[t] = most->first;
    }
  }
  vec3 center(const simplex<2>& t) const {
    return (volume_.points[t[0]] + volume_.points[t[1]] + volume_.points[t[2]]) / 3.0;
  }

  void make_triangles() {
    surface_mesh& surface = made_.surface;
    std::map<local_id, vec2> inner_uv; // by point of the surface
    std::map<local_id, std::multimap<local_id, vec2>> passages;
    for (std::size_t f = 0; f < topology_.faces.size(); ++f) {
      const auto patch = make_face_patch(model_, static_cast<local_id>(f), curves_).boundary;
      for (std::size_t i = 0; i < patch.labels.size(); ++i)
        passages[static_cast<local_id>(f)].emplace(patch.labels[i], patch.uv[i]);
    }
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const local_id f = face_[i];
      const auto& face = topology_.faces[f];
      simplex<2> t = hull_[i];
      if (face.solids[0] == no_id) // the solid lies in front of the face
        std::swap(t[1], t[2]);
      const vec2 near = locate_.nearest(center(t), f).uv;
      std::array<vec2, 3> uv;
      for (std::size_t k = 0; k < 3; ++k) {
        local_id& v = number_[t[k]];
        if (v == no_id) {
          v = static_cast<local_id>(surface.mesh.points.size());
          const vec3 p = volume_.points[t[k]];
          inner_uv[v] = model_.project_to_face(f, p, locate_.nearest(p, f).uv);
          surface.mesh.points.push_back(model_.face_point(f, inner_uv[v]));
          surface.vertex_hosts.push_back({2, f});
        }
        uv[k] = v >= curves_.count ? inner_uv.at(v) : nearest_passage(f, passages[f], v, near);
        t[k] = v;
      }
      surface.mesh.elements.push_back(t);
      surface.mesh.tags.push_back(f);
      surface.corner_uv.push_back(uv);
    }
  }

  /// The parameters of a point on a curve where the face's boundary passes it nearest to `near`.
  vec2 nearest_passage(local_id f, const std::multimap<local_id, vec2>& passages, local_id point,
                       vec2 near) const {
    const surface_frame frame = model_.face_frame(f, near);
    double best = std::numeric_limits<double>::infinity();
    vec2 found = near;
    const auto [first, last] = passages.equal_range(point);
    for (auto it = first; it != last; ++it) {
      const vec2 d = it->second - near;
      if (const double length = norm(d.x * frame.du + d.y * frame.dv); length < best) {
        best = length;
        found = it->second;
      }
    }
    return found;
  }

  void make_volume() {
    simplicial_mesh<3>& out = made_.volume;
    out.points = made_.surface.mesh.points;
    for (simplex<3> element : volume_.elements) {
      for (local_id& v : element) {
        local_id& id = number_[v];
        if (id == no_id) {
          id = static_cast<local_id>(out.points.size());
          out.points.push_back(volume_.points[v]);
        }
        v = id;
      }
      const auto& [a, b, c, d] = element;
      if (!(signed_volume(out.points[a], out.points[b], out.points[c], out.points[d]) > 0))
        throw mesher_error("an element of the background mesh is inverted when its boundary points move to "
                           "the CAD surface; use a mesher that keeps the boundary, or a finer background");
      out.elements.push_back(element);
    }
    out.tags.assign(out.elements.size(), 0);
  }

  const any_geometry& model_;
  const geometry_topology& topology_;
  const surface_mesh& reference_;
  const simplicial_mesh<3>& volume_;
  surface_locator locate_;
  double reach_; ///< within this of a line a point is on it
  std::vector<simplex<2>> hull_;
  curve_points curves_;
  std::vector<std::vector<local_id>> chains_; ///< per curve: points of the volume
  std::set<std::array<local_id, 2>> on_lines_;
  std::vector<local_id> number_; ///< per point of the volume
  std::vector<local_id> face_;   ///< per triangle of the hull
  background_mesh made_;
};

} // namespace detail

DOVETAIL_INLINE background_mesh background_of_whole_domain(const any_geometry& model,
                                                           const surface_mesh& reference,
                                                           const simplicial_mesh<3>& volume) {
  if (model.topology().solids.size() != 1)
    throw mesher_error("a background mesher that keeps no boundary serves models of one solid");
  return detail::boundary_hosts(model, reference, volume).run();
}

} // namespace dovetail::background
