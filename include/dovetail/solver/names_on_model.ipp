/// @file
/// What `names_on_model.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/models/discrete/mesh_boundary.hpp"
#include "dovetail/solver/names_on_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

DOVETAIL_INLINE facing_triangles::facing_triangles(const simplicial_mesh<2>& mesh) : mesh_(&mesh) {
  std::vector<box3> boxes(mesh.elements.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (const local_id v : mesh.elements[t])
      boxes[t].include(point(v));
  tree_ = box_tree(boxes);
}

DOVETAIL_INLINE facing_triangles::found facing_triangles::nearest(vec3 p, vec3 normal,
                                                                  bool either_way) const {
  constexpr double least_cosine = 0.3;
  found best;
  tree_.for_each_near(
      p,
      [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best.distance * best.distance; },
      [&](local_id id) {
        const auto t = static_cast<std::size_t>(id);
        const auto [a, b, c] = corners(t);
        const double turned = dot(normalized(cross(b - a, c - a)), normal);
        if ((either_way ? std::abs(turned) : turned) < least_cosine)
          return;
        const auto w = nearest_on_triangle(a, b, c, p);
        const double away = distance(p, w[0] * a + w[1] * b + w[2] * c);
        if (away < best.distance || (away == best.distance && t < best.triangle))
          best = {t, away};
      });
  return best;
}

DOVETAIL_INLINE double facing_triangles::mean_longest_edge() const {
  double sum = 0;
  for (std::size_t t = 0; t < mesh_->elements.size(); ++t)
    sum += longest_edge(t);
  return sum / std::max(1.0, static_cast<double>(mesh_->elements.size()));
}

/// How much of each entity of a model has which number.
class number_votes {
public:
  number_votes(std::string entity, std::string number, std::size_t entities)
      : entity_(std::move(entity)), number_(std::move(number)), votes_(entities) {}

  void add(local_id entity, local_id number, double size) { votes_[entity][number] += size; }
  /// Per entity the number that most of it has, or `otherwise` where nothing is known. Throws `mesh_error`
  /// where a number cannot come back, since no entity has it as a whole.
  std::vector<local_id> winners(local_id otherwise) const {
    std::vector<local_id> won;
    std::map<local_id, std::size_t> lost; // number, and an entity that has it in part
    for (std::size_t e = 0; e < votes_.size(); ++e) {
      won.push_back(otherwise);
      double most = 0;
      for (const auto& [number, size] : votes_[e])
        if (size > most) {
          most = size;
          won.back() = number;
        }
      for (const auto& [number, size] : votes_[e])
        if (number != won.back()) {
          if (size > largest_stray * most)
            refuse(number, e, won.back());
          lost.emplace(number, e);
        }
    }
    for (const auto& [number, e] : lost)
      if (number != no_id && std::find(won.begin(), won.end(), number) == won.end())
        refuse(number, e, won[e]);
    return won;
  }

private:
  static constexpr double largest_stray = 0.3; ///< what is beside edges may be nearer to a neighbour

  [[noreturn]] void refuse(local_id a, std::size_t entity, local_id b) const {
    const auto name = [&](local_id n) {
      return n == no_id ? "no " + number_ : "the " + number_ + " " + std::to_string(n);
    };
    throw mesh_error("of the model's " + entity_ + " " + std::to_string(entity) + " a part has " + name(a) +
                     " in the mesh, and a part " + name(b) + "; on a model a whole " + entity_ + " has one " +
                     number_ + ": adapt without the model, which keeps such parts");
  }

  std::string entity_, number_;
  std::vector<std::map<local_id, double>> votes_;
};

/// Calls `visit(sample)` for points about `spacing` apart, at most 256 per triangle.
template <class Visit>
void for_each_sample(const any_geometry& model, const surface_mesh& coarse, double spacing,
                     const Visit& visit) {
  constexpr int most = 16;
  for (std::size_t t = 0; t < coarse.mesh.elements.size(); ++t) {
    const auto at = [&](std::size_t k) { return coarse.mesh.points[coarse.mesh.elements[t][k]]; };
    const local_id face = coarse.mesh.tags[t];
    const double longest = std::max({distance(at(0), at(1)), distance(at(1), at(2)), distance(at(2), at(0))});
    const int parts = static_cast<int>(std::clamp(std::ceil(longest / spacing), 1.0, double{most}));
    const double area = 0.5 * norm(cross(at(1) - at(0), at(2) - at(0))) / (parts * parts);
    const vec3 normal = normalized(cross(at(1) - at(0), at(2) - at(0)));
    const auto& uv = coarse.corner_uv[t];
    const auto add = [&](double a, double b) { // barycentric coordinates, in parts
      const double u = a / parts, v = b / parts;
      const vec2 where = (1 - u - v) * uv[0] + u * uv[1] + v * uv[2];
      visit(face_sample{face, model.face_point(face, where), normal, area});
    };
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        add(i + 1.0 / 3, j + 1.0 / 3);
        if (i + j + 1 < parts)
          add(i + 2.0 / 3, j + 2.0 / 3);
      }
  }
}

DOVETAIL_INLINE void strays::look(const face_sample& at, bool is_stray, double away) {
  all_ += at.area;
  if (!is_stray)
    return;
  stray_ += at.area;
  if (away > farthest_ || face_ == no_id) {
    farthest_ = away;
    face_ = at.face;
    point_ = at.point;
  }
}

DOVETAIL_INLINE void strays::refuse_many(const geometry_topology& topology) const {
  if (stray_ <= 0.1 * all_)
    return;
  const std::string& name = topology.faces[face_].name;
  throw mesh_error("the mesh is not one of the model: of the model's face " + std::to_string(face_) +
                   (name.empty() ? name : " '" + name + "'") + " the point (" + number_text(point_.x) + ", " +
                   number_text(point_.y) + ", " + number_text(point_.z) + ") is " +
                   (std::isfinite(farthest_) ? number_text(farthest_) + " away from the mesh's boundary"
                                             : "nowhere near the mesh's boundary") +
                   "; give the model that it was made of, in the same unit, or adapt without one");
}

/// Which of the connected surfaces of a mesh's boundary a model has points on.
class met_surfaces {
public:
  explicit met_surfaces(const simplicial_mesh<2>& boundary) : boundary_(boundary) {
    disjoint_sets together(boundary.points.size());
    for (const auto& [a, b, c] : boundary.elements) {
      together.unite(a, b);
      together.unite(b, c);
    }
    of_point_ = together.number_sets().of_member;
    is_met_.resize(of_point_.size(), false);
  }

  void meet(std::size_t triangle) { is_met_[of_point_[boundary_.elements[triangle][0]]] = true; }

  /// Throws `mesh_error` where the model has nothing at one of them, as where it lacks a void.
  void require_all() const {
    for (const auto& triangle : boundary_.elements)
      if (!is_met_[of_point_[triangle[0]]]) {
        const vec3 at = boundary_.points[triangle[0]];
        throw mesh_error("the mesh is not one of the model: at the mesh's boundary near (" +
                         number_text(at.x) + ", " + number_text(at.y) + ", " + number_text(at.z) +
                         ") the model has nothing; give the model that it was made of, or adapt without one");
      }
  }

private:
  const simplicial_mesh<2>& boundary_;
  std::vector<local_id> of_point_; ///< the surface that each point is of
  std::vector<bool> is_met_;       ///< per surface
};

} // namespace detail

DOVETAIL_INLINE model_names names_on_model(const any_geometry& model, const surface_mesh& coarse,
                                           const mesh_boundary& boundary) {
  const geometry_topology& topology = model.topology();
  const oriented_surfaces& old = boundary.surfaces;
  const detail::facing_triangles surface(old.mesh);
  detail::number_votes ids("face", "id", topology.faces.size());
  detail::number_votes materials("solid", "material", topology.solids.size());
  detail::strays strays;
  detail::met_surfaces met(old.mesh);
  const auto id_of = [&](local_id group) { return group == no_id ? no_id : old.group_numbers[group]; };
  detail::for_each_sample(model, coarse, surface.mean_longest_edge(), [&](const detail::face_sample& at) {
    const auto [behind, front] = topology.faces[at.face].solids;
    if (behind == no_id && front == no_id)
      return;
    const bool both = behind != no_id && front != no_id;
    const vec3 outwards = behind == no_id ? -at.normal : at.normal;
    const auto found = surface.nearest(at.point, outwards, both);
    const bool stray = detail::is_stray(surface, found);
    strays.look(at, stray, found.distance);
    if (stray)
      return;
    const std::size_t t = found.triangle;
    met.meet(t);
    ids.add(at.face, id_of(old.groups[t]), at.area);
    const auto& v = old.mesh.elements[t];
    const auto corner = [&](std::size_t k) { return old.mesh.points[v[k]]; };
    const bool same_way = dot(cross(corner(1) - corner(0), corner(2) - corner(0)), at.normal) > 0;
    const auto material = [&](local_id solid) {
      return solid == no_id ? no_id : boundary.material_of_solid[solid];
    };
    if (behind != no_id)
      materials.add(behind, material(same_way ? old.solid_of[t] : old.front_of[t]), at.area);
    if (front != no_id)
      materials.add(front, material(same_way ? old.front_of[t] : old.solid_of[t]), at.area);
  });
  strays.refuse_many(topology);
  met.require_all();
  model_names names;
  names.id_of_face = ids.winners(no_id);
  names.material_of_solid = materials.winners(no_id);
  for (std::size_t s = 0; s < names.material_of_solid.size(); ++s)
    if (names.material_of_solid[s] == no_id)
      throw mesh_error(
          "the model's solid " + std::to_string(s) +
          " has no elements in the mesh; give the model that it was made of, or adapt without one");
  for (const local_id id : old.group_numbers)
    if (std::find(names.id_of_face.begin(), names.id_of_face.end(), id) == names.id_of_face.end())
      throw mesh_error("no face of the model has the id " + std::to_string(id) +
                       " that sides of the mesh have; adapt without the model, which keeps it");
  return names;
}

DOVETAIL_INLINE model_names names_on_model(const any_geometry& model, const surface_mesh& coarse,
                                           const simplicial_mesh<2>& mesh,
                                           const std::vector<simplex<1>>& edges,
                                           const std::vector<local_id>& edge_ids_given) {
  const geometry_topology& topology = model.topology();
  const detail::facing_triangles surface(mesh);
  const double spacing = surface.mean_longest_edge();
  detail::number_votes ids("face", "id", topology.faces.size());
  detail::strays strays;
  detail::for_each_sample(model, coarse, spacing, [&](const detail::face_sample& at) {
    const auto found = surface.nearest(at.point, at.normal, true);
    const bool stray = detail::is_stray(surface, found);
    strays.look(at, stray, found.distance);
    if (!stray)
      ids.add(at.face, mesh.tags.empty() ? no_id : mesh.tags[found.triangle], at.area);
  });
  strays.refuse_many(topology);
  model_names names;
  names.id_of_face = ids.winners(no_id);

  names.id_of_curve.assign(topology.curves.size(), no_id);
  if (edges.empty())
    return names;
  edge_ids known(mesh.points, edges, edge_ids_given);
  detail::number_votes curves("curve", "id", topology.curves.size());
  for (const auto& edge : coarse.curve_edges) {
    const auto end = [&](std::size_t k) { return coarse.mesh.points[edge.vertices[k]]; };
    const double length = distance(end(0), end(1));
    const int parts = static_cast<int>(std::clamp(std::ceil(2 * length / spacing), 1.0, 64.0));
    for (int k = 0; k < parts; ++k) {
      const double t = edge.t[0] + (k + 0.5) / parts * (edge.t[1] - edge.t[0]);
      curves.add(edge.curve, known.at(model.curve_point(edge.curve, t), 0.3), length / parts);
    }
  }
  names.id_of_curve = curves.winners(no_id);
  std::vector<local_id> missed, given = edge_ids_given;
  sort_unique(given);
  for (const local_id id : given)
    if (id != no_id &&
        std::find(names.id_of_curve.begin(), names.id_of_curve.end(), id) == names.id_of_curve.end())
      missed.push_back(id);
  if (!missed.empty())
    names.warnings.push_back(std::to_string(missed.size()) + " ids of edges, the first of them " +
                             std::to_string(missed.front()) +
                             ", are on no curve of the model; the adapted mesh knows nothing of them");
  return names;
}

} // namespace dovetail
