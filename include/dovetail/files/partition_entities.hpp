/// @file
/// The entities of a partition: maximal sets of skeleton points, edges and triangles on the same CAD entity,
/// or in the interior of a solid, with the same sharers.
#pragma once

#include "dovetail/files/skeleton_entities.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// What the edges and triangles at a point say about it.
struct point_neighbourhood {
  local_id face = no_id; ///< a face at the point
  local_id line = no_id; ///< a line at the point
  int line_edges = 0;
  int faces = 0;          ///< distinct faces at the point
  int faces_at_lines = 0; ///< those of them that have a line edge at the point
  bool several_lines = false;

  void meet_line(local_id at) {
    several_lines = several_lines || (line != no_id && line != at);
    line = at;
    ++line_edges;
  }
  /// In the interior of its only face.
  bool inside_face() const { return line == no_id && faces == 1; }
  /// One line passes through, and no face touches it in this point alone.
  bool inside_line() const { return line_edges == 2 && !several_lines && faces == faces_at_lines; }
};

using point_faces = std::vector<std::array<local_id, 2>>; ///< (point, face) pairs

inline void keep_distinct(point_faces& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// The faces: triangles with the same CAD face (or none) and the same subdomains at their sides.
inline void classify_triangles(skeleton_entities& entities, const distributed_mesh& mesh) {
  entity_numbering faces(entities.of_dimension[2]);
  for (std::size_t t = 0; t < mesh.skeleton.sides.size(); ++t) {
    const auto [behind, front] = mesh.skeleton.subdomains[t];
    const auto f = mesh.skeleton.side_hosts[t];
    std::vector<local_id> sharers{behind};
    if (front != no_id && front != behind)
      sharers.insert(front < behind ? sharers.begin() : sharers.end(), front);
    entities.of_triangle.push_back(
        faces(f == no_id ? host{3, material_of(mesh, behind)} : host{2, f}, sharers));
  }
}

/// The CAD curve of an edge given by ascending vertices, or no_id.
class curve_lookup {
public:
  explicit curve_lookup(const fine_skeleton& skeleton) {
    for (std::size_t e = 0; e < skeleton.curve_edges.size(); ++e)
      edges_.push_back(
          {sorted_vertices(skeleton.curve_edges[e]), skeleton.curve_edges[e], skeleton.curves[e]});
    std::sort(edges_.begin(), edges_.end(), [](const entry& a, const entry& b) { return a.key < b.key; });
  }
  struct entry {
    simplex<1> key;
    simplex<1> directed;
    local_id curve;
  };
  const entry* find(const simplex<1>& key) const {
    const auto at = std::lower_bound(edges_.begin(), edges_.end(), key,
                                     [](const entry& a, const simplex<1>& k) { return a.key < k; });
    return at != edges_.end() && at->key == key ? &*at : nullptr;
  }

private:
  std::vector<entry> edges_;
};

/// The lines: edges on a CAD curve, and edges where different faces meet. Returns the faces that have a line
/// edge at a point.
inline point_faces classify_edges(skeleton_entities& entities, const distributed_mesh& mesh) {
  point_faces at_lines;
  const auto& skeleton = mesh.skeleton;
  const curve_lookup curves(skeleton);
  entity_numbering lines(entities.of_dimension[1]);
  const auto face_of = [&](std::uint32_t half_edge) { return entities.of_triangle[half_edge / 3]; };
  for_each_group<2>(
      3 * skeleton.sides.size(), skeleton.points.size(),
      [&](std::size_t i) {
        const auto& triangle = skeleton.sides[i / 3];
        return sorted_vertices(simplex<1>{triangle[i % 3], triangle[(i + 1) % 3]});
      },
      [&](const simplex<1>& key, std::span<const std::uint32_t> half_edges) {
        const auto* on_curve = curves.find(key);
        const bool inside_face = std::all_of(half_edges.begin(), half_edges.end(), [&](std::uint32_t h) {
          return face_of(h) == face_of(half_edges.front());
        });
        if (on_curve == nullptr && inside_face)
          return;
        std::set<local_id> sharers;
        host on{3, no_id};
        for (const auto h : half_edges) {
          const auto& face = entities.of_dimension[2][face_of(h)];
          sharers.insert(face.sharers.begin(), face.sharers.end());
          on = on.id == no_id ? face.on : std::min(on, face.on);
          for (const auto v : key)
            at_lines.push_back({v, face_of(h)});
        }
        if (on_curve != nullptr)
          on = {1, on_curve->curve};
        entities.edges.push_back(
            {on_curve != nullptr ? on_curve->directed : key, lines(on, {sharers.begin(), sharers.end()})});
      });
  keep_distinct(at_lines);
  return at_lines;
}

inline std::vector<point_neighbourhood> look_around_points(const skeleton_entities& entities,
                                                           const fine_skeleton& skeleton,
                                                           const point_faces& at_lines) {
  std::vector<point_neighbourhood> around(skeleton.points.size());
  const auto at = [&](local_id v) -> point_neighbourhood& { return around[v]; };
  point_faces all;
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t)
    for (const auto v : skeleton.sides[t])
      all.push_back({v, entities.of_triangle[t]});
  keep_distinct(all);
  for (const auto& [v, face] : all) {
    at(v).face = face;
    ++at(v).faces;
  }
  for (const auto& [v, face] : at_lines)
    ++at(v).faces_at_lines;
  for (const auto& edge : entities.edges)
    for (const auto v : edge.vertices)
      at(v).meet_line(edge.line);
  return around;
}

/// Vertices where lines end, branch or turn into another line, where faces touch in a point, and at CAD
/// vertices; other points are on their line or face.
inline void classify_points(skeleton_entities& entities, const distributed_mesh& mesh,
                            const point_sharers& sharers, const point_faces& at_lines) {
  const auto& skeleton = mesh.skeleton;
  const auto around = look_around_points(entities, skeleton, at_lines);
  for (std::size_t v = 0; v < around.size(); ++v) {
    const auto& at = around[v];
    const auto on = skeleton.point_hosts[v];
    if (at.face == no_id)
      entities.of_point.push_back({3, no_id});
    else if (on.dimension != 0 && at.inside_face())
      entities.of_point.push_back({2, at.face});
    else if (on.dimension != 0 && at.inside_line())
      entities.of_point.push_back({1, at.line});
    else {
      const auto sharing = sharers[static_cast<local_id>(v)];
      entities.of_point.push_back({0, static_cast<local_id>(entities.of_dimension[0].size())});
      entities.of_dimension[0].push_back(
          {on.dimension == 3 ? host{3, material_of(mesh, sharing.front())} : on,
           {sharing.begin(), sharing.end()},
           {}});
    }
  }
}

/// Turns the edges of lines that are on no curve so that they run the same way along each line.
inline void direct_lines(skeleton_entities& entities) {
  struct end {
    local_id point;
    local_id line;
    std::size_t edge;
  };
  std::vector<end> ends;
  const auto on_curve = [&](std::size_t e) {
    return entities.of_dimension[1][entities.edges[e].line].on.dimension == 1;
  };
  for (std::size_t e = 0; e < entities.edges.size(); ++e)
    if (!on_curve(e))
      for (const auto v : entities.edges[e].vertices)
        ends.push_back({v, entities.edges[e].line, e});
  std::sort(ends.begin(), ends.end(), [](const end& a, const end& b) {
    return std::tuple(a.point, a.line, a.edge) < std::tuple(b.point, b.line, b.edge);
  });
  const auto next_edge = [&](std::size_t e, local_id through) {
    if (entities.of_point[through].dimension == 0)
      return e; // the line ends here
    const auto at = std::lower_bound(ends.begin(), ends.end(), through,
                                     [](const end& a, local_id point) { return a.point < point; });
    return at->edge == e ? std::next(at)->edge : at->edge;
  };
  std::vector<bool> directed(entities.edges.size(), false);
  const auto follow = [&](std::size_t first, std::size_t head) {
    for (auto e = first;;) {
      directed[e] = true;
      const auto through = entities.edges[e].vertices[head];
      const auto next = next_edge(e, through);
      if (directed[next])
        return;
      if (entities.edges[next].vertices[1 - head] != through)
        std::swap(entities.edges[next].vertices[0], entities.edges[next].vertices[1]);
      e = next;
    }
  };
  for (std::size_t e = 0; e < entities.edges.size(); ++e)
    if (!on_curve(e) && !directed[e]) {
      follow(e, 1);
      follow(e, 0);
    }
}

} // namespace detail

/// Classifies the whole skeleton. Every line has one CAD entity (or solid) and one set of sharers, but may
/// have several components; a vertex is one point. Volumes are subdomains.
/// O(skeleton, log for sorting).
inline skeleton_entities partition_entities(const distributed_mesh& mesh, const point_sharers& sharers) {
  skeleton_entities result;
  result.triangles = detail::turn_to_lower(mesh);
  detail::classify_triangles(result, mesh);
  const auto at_lines = detail::classify_edges(result, mesh);
  detail::classify_points(result, mesh, sharers, at_lines);
  detail::direct_lines(result);
  for (local_id s = 0; s < static_cast<local_id>(mesh.counts.size()); ++s)
    result.of_dimension[3].push_back({{3, detail::material_of(mesh, s)}, {s}, {}});
  detail::bound_volumes(result, mesh, [](local_id s) { return s; });
  detail::finish_boundaries(result);
  return result;
}

} // namespace dovetail::io
