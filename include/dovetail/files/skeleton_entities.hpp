/// @file
/// The entities that the points, edges and triangles of a skeleton make up: those of the CAD model, or those
/// of the partition, which are the pieces of CAD entities and of interfaces that have the same sharers.
///
/// A point belongs to exactly one entity, the one of lowest dimension that it lies on. Everything follows
/// from the skeleton alone: what bounds what is read off the mesh, not off the CAD model.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/skeleton_index.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::io {

/// An entity on the boundary of another one, and whether it runs against the direction it has there.
struct bounding_entity {
  local_id entity = no_id; ///< its number within its dimension
  bool reversed = false;   ///< whether it runs against the direction it has there

  friend constexpr auto operator<=>(const bounding_entity&, const bounding_entity&) = default;
};

/// A vertex, line or face of the skeleton, or a volume that it bounds.
struct skeleton_entity {
  host on;                       ///< the CAD entity that it is, or is part of; {3, material} inside a solid
  std::vector<local_id> sharers; ///< ascending subdomains; empty for entities of the CAD model
  std::vector<bounding_entity> boundary; ///< entities of one dimension less; sorted, but a line's start first
};

/// The entities of a skeleton.
struct skeleton_entities {
  /// By dimension: vertices (of one point each), lines, faces, volumes. Volume i is material i of a CAD
  /// model, or subdomain i of a partition.
  std::array<std::vector<skeleton_entity>, 4> of_dimension;
  /// Per point of the skeleton: dimension and index of its entity; {3, no_id} for points without triangles.
  std::vector<host> of_point;
  /// An edge of the skeleton that lies on a line.
  struct edge {
    simplex<1> vertices; ///< in the direction of the line
    local_id line;       ///< the line that it is on
  };
  std::vector<edge> edges;           ///< of the skeleton, each once
  std::vector<local_id> of_triangle; ///< face of each triangle, or no_id
  std::vector<simplex<2>> triangles; ///< those of the skeleton, facing away from the lower volume
};

namespace detail {

/// Numbers entities of one dimension by their CAD entity and sharers.
class entity_numbering {
public:
  explicit entity_numbering(std::vector<skeleton_entity>& entities) : entities_(entities) {}

  local_id operator()(host on, const std::vector<local_id>& sharers) {
    const auto [at, is_new] =
        known_.try_emplace(std::pair(on, sharers), static_cast<local_id>(entities_.size()));
    if (is_new)
      entities_.push_back({on, sharers, {}});
    return at->second;
  }

private:
  std::vector<skeleton_entity>& entities_;
  std::map<std::pair<host, std::vector<local_id>>, local_id> known_;
};

inline local_id material_of(const distributed_mesh& mesh, local_id subdomain) {
  return mesh.counts[subdomain].material;
}

/// The skeleton's triangles, each turned to face away from the one of its two subdomains that has the lower
/// material, then the lower number: so the triangles of an entity face the same way.
inline std::vector<simplex<2>> turn_to_lower(const distributed_mesh& mesh) {
  std::vector<simplex<2>> triangles(mesh.skeleton.sides.begin(), mesh.skeleton.sides.end());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [behind, front] = mesh.skeleton.subdomains[t];
    if (front != no_id &&
        std::pair(material_of(mesh, front), front) < std::pair(material_of(mesh, behind), behind))
      std::swap(triangles[t][1], triangles[t][2]);
  }
  return triangles;
}

/// Which faces bound each volume, reversed where they face inwards; `volume_of(subdomain)` numbers volumes.
/// O(triangles).
template <class Function>
void bound_volumes(skeleton_entities& entities, const distributed_mesh& mesh, Function volume_of) {
  for (std::size_t t = 0; t < entities.triangles.size(); ++t) {
    if (entities.of_triangle[t] == no_id)
      continue;
    const bool turned = entities.triangles[t] != mesh.skeleton.sides[t];
    for (std::size_t side = 0; side < 2; ++side)
      if (const auto s = mesh.skeleton.subdomains[t][side]; s != no_id) {
        const bounding_entity face{entities.of_triangle[t], turned != (side == 1)};
        auto& faces = entities.of_dimension[3][volume_of(s)].boundary;
        if (faces.empty() || faces.back() != face) // most repetitions follow each other
          faces.push_back(face);
      }
  }
}

/// Which lines bound each face, and which vertices each line. O(triangles log edges).
inline void bound_faces_and_lines(skeleton_entities& entities) {
  auto sorted = entities.edges;
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return sorted_vertices(a.vertices) < sorted_vertices(b.vertices);
  });
  for (std::size_t t = 0; t < entities.triangles.size(); ++t) {
    if (entities.of_triangle[t] == no_id)
      continue;
    auto& face = entities.of_dimension[2][entities.of_triangle[t]];
    for (std::size_t k = 0; k < 3; ++k) {
      const simplex<1> side{entities.triangles[t][k], entities.triangles[t][(k + 1) % 3]};
      const auto at = std::lower_bound(
          sorted.begin(), sorted.end(), sorted_vertices(side),
          [](const auto& edge, const simplex<1>& key) { return sorted_vertices(edge.vertices) < key; });
      if (at != sorted.end() && sorted_vertices(at->vertices) == sorted_vertices(side))
        face.boundary.push_back({at->line, at->vertices != side});
    }
  }
  for (const auto& edge : entities.edges)
    for (std::size_t end = 0; end < 2; ++end)
      if (const auto at = entities.of_point[edge.vertices[end]]; at.dimension == 0)
        entities.of_dimension[1][edge.line].boundary.push_back({at.id, end == 1});
}

inline void keep_distinct(std::vector<bounding_entity>& boundary) {
  std::sort(boundary.begin(), boundary.end());
  boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
}

inline void finish_boundaries(skeleton_entities& entities) {
  bound_faces_and_lines(entities);
  for (auto& dimension : entities.of_dimension)
    for (auto& entity : dimension)
      keep_distinct(entity.boundary);
  for (auto& line : entities.of_dimension[1]) // readers take the first vertex for the start
    std::stable_partition(line.boundary.begin(), line.boundary.end(),
                          [](const bounding_entity& vertex) { return !vertex.reversed; });
}

/// The ascending subdomains at each point, as (point, subdomain) pairs in order. O(triangles log triangles).
inline std::vector<std::array<local_id, 2>> subdomains_at_points(const fine_skeleton& skeleton) {
  std::vector<std::array<local_id, 2>> pairs;
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t)
    for (const auto v : skeleton.sides[t])
      for (const auto s : skeleton.subdomains[t])
        if (s != no_id)
          pairs.push_back({v, s});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

} // namespace detail

/// The subdomains at each point of a skeleton.
class point_sharers {
public:
  explicit point_sharers(const fine_skeleton& skeleton) : start_(skeleton.points.size() + 1, 0) {
    for (const auto& [point, subdomain] : detail::subdomains_at_points(skeleton)) {
      ++start_[static_cast<std::size_t>(point) + 1];
      items_.push_back(subdomain);
    }
    for (std::size_t v = 1; v < start_.size(); ++v)
      start_[v] += start_[v - 1];
  }
  /// Ascending; empty for a point without triangles.
  std::span<const local_id> operator[](local_id point) const {
    const auto v = static_cast<std::size_t>(point);
    return std::span(items_).subspan(start_[v], start_[v + 1] - start_[v]);
  }

private:
  std::vector<std::size_t> start_;
  std::vector<local_id> items_;
};

/// The entities of the CAD model that the mesh shows: triangles with a CAD face, edges on CAD curves, points
/// at CAD vertices. Volumes are materials.
/// \param materials how many materials there are
inline skeleton_entities cad_entities(const distributed_mesh& mesh, const point_sharers& sharers,
                                      std::size_t materials) {
  const auto& skeleton = mesh.skeleton;
  skeleton_entities result;
  detail::entity_numbering vertices(result.of_dimension[0]), lines(result.of_dimension[1]),
      faces(result.of_dimension[2]);
  result.triangles = detail::turn_to_lower(mesh);
  for (const auto f : skeleton.side_hosts)
    result.of_triangle.push_back(f == no_id ? no_id : faces({2, f}, {}));
  for (std::size_t e = 0; e < skeleton.curve_edges.size(); ++e)
    result.edges.push_back({skeleton.curve_edges[e], lines({1, skeleton.curves[e]}, {})});
  for (std::size_t v = 0; v < skeleton.points.size(); ++v) {
    const auto on = skeleton.point_hosts[v];
    const auto at = sharers[static_cast<local_id>(v)];
    if (at.empty())
      result.of_point.push_back({3, no_id});
    else if (on.dimension == 3)
      result.of_point.push_back({3, detail::material_of(mesh, at.front())});
    else
      result.of_point.push_back({on.dimension, on.dimension == 0   ? vertices(on, {})
                                               : on.dimension == 1 ? lines(on, {})
                                                                   : faces(on, {})});
  }
  for (std::size_t m = 0; m < materials; ++m)
    result.of_dimension[3].push_back({{3, static_cast<local_id>(m)}, {}, {}});
  detail::bound_volumes(result, mesh, [&](local_id s) { return detail::material_of(mesh, s); });
  detail::finish_boundaries(result);
  return result;
}

} // namespace dovetail::io
