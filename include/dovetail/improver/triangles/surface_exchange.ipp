/// @file
/// What `surface_exchange.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/point_numbering.hpp"
#include "dovetail/improver/triangles/surface_complex.hpp"
#include "dovetail/improver/triangles/surface_exchange.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/sizing/checked_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::improvement::detail {

DOVETAIL_INLINE void require_triangles(const simplicial_mesh<2>& mesh) {
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    throw mesh_error("the mesh has " + std::to_string(mesh.elements.size()) + " triangles but " +
                     std::to_string(mesh.tags.size()) + " tags");
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (!std::isfinite(norm_squared(mesh.points[v])))
      throw mesh_error("point " + std::to_string(v) + " has a coordinate that is not finite or too large");
  for (std::size_t t = 0; t < mesh.elements.size(); ++t) {
    const auto& [a, b, c] = mesh.elements[t];
    if (a == b || b == c || c == a)
      throw mesh_error("triangle " + std::to_string(t) + " uses a point twice");
  }
}

/// Builds a `surface_complex`: which sides are fixed, which fans of triangles they leave, and where each
/// lies.
class surface_taker {
public:
  surface_taker(const simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen, const surface_host& host,
                double feature_angle)
      : mesh_(mesh), frozen_(frozen), host_(host),
        cos_feature_(std::cos(feature_angle * std::numbers::pi / 180)), corners_(3 * mesh.elements.size()) {}

  void fill(surface_complex& made) {
    find_twins(made.table);
    name_fans(made);
    find_patches(made);
    find_normals(made);
    if (!host_ && std::any_of(made.patches.begin(), made.patches.end(),
                              [](const surface_patch& patch) { return !patch.is_plane; }))
      made.given = triangle_host(made.point, triangles_of(made.table), made.normal);
  }

private:
  vec3 point_at(local_id corner) const { return mesh_.points[point_of(corner)]; }
  local_id point_of(local_id corner) const { return mesh_.elements[corner / 3][corner % 3]; }
  local_id tag(local_id t) const { return mesh_.tags.empty() ? 0 : mesh_.tags[t]; }
  vec3 area(local_id t) const {
    const vec3 a = point_at(3 * t);
    return cross(point_at(3 * t + 1) - a, point_at(3 * t + 2) - a);
  }

  /// Side i of a triangle is the one opposite its corner i.
  void find_twins(corner_table& table) {
    table.twin.assign(corners_, no_id);
    table.constraint.assign(corners_, no_id);
    std::vector<std::array<local_id, 2>> listed = frozen_.sides;
    for (auto& side : listed)
      sort_all(side);
    sort_unique(listed);
    std::vector<bool> is_found(listed.size(), false);
    const side_table<2> sides = build_sides(mesh_);
    std::vector<local_id> first(sides.size(), no_id); // the first corner opposite each side
    for (std::size_t c = 0; c < corners_; ++c) {
      const auto corner = static_cast<local_id>(c);
      const local_id side = sides.of_element[c / 3][c % 3];
      local_id& other = first[side];
      if (other == no_id) {
        other = corner;
        const auto key = sorted_vertices(sides.vertices[side]);
        const auto found = std::lower_bound(listed.begin(), listed.end(), key);
        if (found != listed.end() && *found == key) {
          is_found[found - listed.begin()] = true;
          other = -2; // fixed
        }
      } else if (other >= 0 && sides.is_interior(side) && joins_smoothly(other, corner)) {
        table.glue(other, corner);
      }
    }
    for (std::size_t k = 0; k < listed.size(); ++k)
      if (!is_found[k])
        throw mesh_error("frozen side (" + std::to_string(listed[k][0]) + ", " +
                         std::to_string(listed[k][1]) + ") is not a side of the mesh");
  }
  /// True when the side opposite both corners may be changed.
  bool joins_smoothly(local_id c, local_id d) const {
    const local_id t = c / 3, u = d / 3;
    if (point_of(corner_table::next(c)) == point_of(corner_table::next(d)))
      throw mesh_error("triangles " + std::to_string(t) + " and " + std::to_string(u) +
                       " pass their common side in the same direction; orient the mesh");
    if (tag(t) != tag(u) || point_of(c) == point_of(d))
      return false;
    if (host_)
      return true;
    const vec3 n = area(t), m = area(u);
    const double lengths = std::sqrt(norm_squared(n) * norm_squared(m));
    // Flat triangles turn by nothing, and those turned over in a plane are to be mended.
    return !(lengths > 0) || dot(n, m) >= cos_feature_ * lengths || is_folded_flat(n, m, lengths);
  }
  static bool is_folded_flat(vec3 n, vec3 m, double lengths) { return dot(n, m) < -(1 - 1e-12) * lengths; }

  /// One vertex per run of triangles around a point between two fixed sides; those that cannot move first.
  void name_fans(surface_complex& made) {
    const corner_table& table = made.table;
    struct fan {
      local_id point;
      bool is_closed;
    };
    std::vector<fan> fans;
    std::vector<local_id> fan_of(corners_, no_id);
    std::vector<local_id> fans_at(mesh_.points.size(), 0);
    for (std::size_t c = 0; c < corners_; ++c) {
      if (fan_of[c] != no_id)
        continue;
      const auto name = static_cast<local_id>(fans.size());
      const auto first = static_cast<local_id>(c);
      bool is_closed = false;
      for (local_id d = first; d != no_id; d = table.counter_clockwise(d)) {
        if (fan_of[d] == name) {
          is_closed = true;
          break;
        }
        fan_of[d] = name;
      }
      for (local_id d = first; d != no_id && !is_closed; d = table.clockwise(d))
        fan_of[d] = name;
      fans.push_back({point_of(first), is_closed});
      ++fans_at[point_of(first)];
    }

    std::vector<local_id> vertex_of(fans.size(), no_id);
    const auto is_free = [&](const fan& f) {
      return f.is_closed && fans_at[f.point] == 1 && f.point >= frozen_.points;
    };
    local_id count = 0;
    for (const bool wanted : {false, true}) {
      for (std::size_t f = 0; f < fans.size(); ++f)
        if (is_free(fans[f]) == wanted) {
          vertex_of[f] = count++;
          made.source.push_back(fans[f].point);
        }
      if (!wanted)
        made.frozen = count;
    }
    made.table.corner_of.assign(count, no_id);
    made.table.vertex.resize(corners_);
    for (std::size_t c = 0; c < corners_; ++c) {
      const local_id v = vertex_of[fan_of[c]];
      made.table.vertex[c] = v;
      if (made.table.corner_of[v] == no_id)
        made.table.corner_of[v] = static_cast<local_id>(c);
    }
    link_fans(made);
  }
  void link_fans(surface_complex& made) const {
    const std::size_t count = made.source.size();
    made.next_fan.resize(count);
    std::vector<local_id> last(mesh_.points.size(), no_id);
    for (std::size_t v = 0; v < count; ++v) {
      const auto id = static_cast<local_id>(v);
      local_id& other = last[made.source[v]];
      made.next_fan[v] = other == no_id ? id : std::exchange(made.next_fan[other], id);
      other = id;
      made.point.push_back(mesh_.points[made.source[v]]);
    }
  }

  /// Patches and which of them are plane.
  void find_patches(surface_complex& made) const {
    disjoint_sets joined(mesh_.elements.size());
    for (std::size_t c = 0; c < corners_; ++c)
      if (made.table.twin[c] != no_id)
        joined.unite(static_cast<local_id>(c / 3), made.table.twin[c] / 3);
    const auto sets = joined.number_sets();
    made.patches.resize(sets.count);
    made.patch.assign(made.source.size(), no_id);
    std::vector<vec3> sums(sets.count), start(sets.count);
    for (std::size_t t = 0; t < mesh_.elements.size(); ++t) {
      const auto id = static_cast<local_id>(t);
      const std::size_t patch = sets.of_member[t];
      made.patches[patch].tag = tag(id);
      start[patch] = point_at(3 * id);
      sums[patch] += area(id);
      for (std::size_t k = 0; k < 3; ++k)
        made.patch[made.table.vertex[3 * t + k]] = sets.of_member[t];
    }
    std::vector<double> reach(made.patches.size(), 0), height(made.patches.size(), 0);
    for (std::size_t k = 0; k < made.patches.size(); ++k)
      made.patches[k].normal = normalized(sums[k]);
    if (host_) {
      for (surface_patch& patch : made.patches)
        if (const vec3 n = host_.plane_normal ? host_.plane_normal(patch.tag) : vec3{}; norm_squared(n) > 0)
          patch = {patch.tag, true, n};
      return;
    }
    for (std::size_t v = 0; v < made.patch.size(); ++v) {
      const std::size_t k = made.patch[v];
      const vec3 away = made.point[v] - start[k];
      reach[k] = std::max(reach[k], norm(away));
      height[k] = std::max(height[k], std::abs(dot(away, made.patches[k].normal)));
    }
    for (std::size_t k = 0; k < made.patches.size(); ++k)
      made.patches[k].is_plane = norm_squared(sums[k]) > 0 && height[k] <= 1e-12 * reach[k];
  }

  void find_normals(surface_complex& made) const {
    const std::size_t count = made.source.size();
    made.uv.assign(count, {});
    made.on.assign(count, no_id);
    std::vector<vec3> sums(count);
    for (std::size_t c = 0; c < corners_; ++c) {
      const std::size_t v = made.table.vertex[c];
      made.on[v] = static_cast<local_id>(c / 3);
      sums[v] += area(static_cast<local_id>(c / 3));
      if (!host_.corner_uv.empty())
        made.uv[v] = host_.corner_uv[c / 3][c % 3];
    }
    for (std::size_t v = 0; v < count; ++v) {
      const surface_patch& patch = made.patches[made.patch[v]];
      made.normal.push_back(patch.is_plane ? patch.normal : normalized(sums[v]));
      if (!host_ || patch.is_plane)
        continue;
      const host_point found = host_.corner_uv.empty() || !host_.evaluate
                                   ? host_.project(patch.tag, made.point[v], made.uv[v])
                                   : host_.evaluate(patch.tag, made.uv[v]);
      made.uv[v] = found.uv;
      if (norm_squared(found.normal) > 0)
        made.normal[v] = found.normal;
    }
  }

  static std::vector<simplex<2>> triangles_of(const corner_table& table) {
    std::vector<simplex<2>> triangles(table.vertex.size() / 3);
    for (std::size_t c = 0; c < table.vertex.size(); ++c)
      triangles[c / 3][c % 3] = table.vertex[c];
    return triangles;
  }

  const simplicial_mesh<2>& mesh_;
  const frozen_entities<2>& frozen_;
  const surface_host& host_;
  double cos_feature_;
  std::size_t corners_;
};

} // namespace dovetail::improvement::detail

namespace dovetail::improvement {

DOVETAIL_INLINE surface_complex take_surface(const simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen,
                                             const any_sizing& size, const surface_host& host,
                                             double feature_angle) {
  detail::require_triangles(mesh);
  if (!host.corner_uv.empty() && host.corner_uv.size() != mesh.elements.size())
    throw mesh_error("the mesh has " + std::to_string(mesh.elements.size()) + " triangles but " +
                     std::to_string(host.corner_uv.size()) + " have parameters");
  surface_complex made;
  made.field = &size;
  made.host = &host;
  detail::surface_taker(mesh, frozen, host, feature_angle).fill(made);
  made.size.assign(made.point.size(), 0);
  for (local_id v = 0; v < static_cast<local_id>(made.point.size()); ++v)
    made.size[v] = size ? checked_size(size, made.point[v]) : 0;
  if (!size) {
    std::vector<int> sides(made.point.size(), 0);
    for (local_id c = 0; c < static_cast<local_id>(made.table.vertex.size()); ++c)
      for (const auto& [v, w] : {std::array{made.table.tail(c), made.table.head(c)},
                                 std::array{made.table.head(c), made.table.tail(c)}}) {
        made.size[v] += made.length(v, w);
        ++sides[v];
      }
    for (std::size_t v = 0; v < sides.size(); ++v)
      made.size[v] /= sides[v];
  }
  return made;
}

DOVETAIL_INLINE void give_back(const surface_complex& made, simplicial_mesh<2>& mesh,
                               std::vector<std::array<vec2, 3>>* corner_uv) {
  const auto& table = made.table;
  std::vector<bool> is_fixed(mesh.points.size(), true);
  std::vector<local_id> number(made.source);
  std::vector<local_id> free;
  for (local_id v = made.frozen; v < static_cast<local_id>(made.point.size()); ++v) {
    if (made.source[v] != no_id)
      is_fixed[made.source[v]] = false;
    if (table.corner_of[v] != no_id)
      free.push_back(v);
  }
  const point_numbering numbers(is_fixed, free.size());
  mesh.points.resize(numbers.size);
  for (std::size_t k = 0; k < free.size(); ++k) {
    number[free[k]] = numbers.of_free[k];
    mesh.points[numbers.of_free[k]] = made.point[free[k]];
  }
  const bool has_tags = !mesh.tags.empty();
  mesh.elements.clear();
  mesh.tags.clear();
  if (corner_uv != nullptr)
    corner_uv->clear();
  for (local_id t = 0; t < table.triangle_slots(); ++t) {
    if (!table.alive(t))
      continue;
    simplex<2> triangle;
    std::array<vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const local_id v = table.vertex[3 * t + k];
      triangle[k] = number[v];
      uv[k] = made.uv[v];
    }
    mesh.elements.push_back(triangle);
    if (has_tags)
      mesh.tags.push_back(made.patches[made.patch[table.vertex[3 * t]]].tag);
    if (corner_uv != nullptr)
      corner_uv->push_back(uv);
  }
  fill_gaps(numbers, mesh);
}

} // namespace dovetail::improvement
