/// @file
/// The improver's view of a surface: triangles with their neighbours, and where their vertices lie.
#pragma once

#include "dovetail/core/predicates.hpp"
#include "dovetail/improver/surface_host.hpp"
#include "dovetail/mesh/corner_table.hpp"
#include "dovetail/mesh/triangle_shape.hpp"
#include "dovetail/sizing/checked_size.hpp"
#include "dovetail/sizing/concepts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace dovetail::improvement {

/// A part of the surface that no fixed side crosses.
struct surface_patch {
  local_id tag = 0;      ///< of its triangles
  bool is_plane = false; ///< its vertices move in the plane exactly and need no host
  vec3 normal;           ///< of a plane patch
};

/// A triangulation that is valid in space at every step; a state of mesh/surface_operations.hpp.
///
/// Vertices are (point, patch) pairs: where fixed sides meet at a point, every fan of triangles between two
/// of them has a vertex of its own, with its own normal and parameters. So the corner table has no
/// constraints: a fixed side is a boundary. Vertices [0, frozen) never move; those after them have a closed
/// star.
class surface_complex {
public:
  /// All that a move changes.
  struct location {
    vec3 point, normal;  ///< of the vertex, and of the surface there
    vec2 uv;             ///< on the surface
    local_id on = no_id; ///< triangle of the given mesh, where that is the host
  };

  corner_table table;       ///< the triangles
  std::vector<vec3> point;  ///< by vertex: where it is
  std::vector<vec3> normal; ///< unit, of the host; zero where it is singular
  std::vector<vec2> uv;     ///< by vertex: its parameters on the surface
  /// By vertex: the triangle of the given mesh that it is on, where that is the host.
  std::vector<local_id> on;
  std::vector<local_id> patch;                  ///< by vertex: its patch
  std::vector<local_id> source;                 ///< index of the point in the given mesh, no_id for new ones
  std::vector<local_id> next_fan;               ///< the next vertex at the same point; itself when alone
  std::vector<double> size;                     ///< target edge length
  std::vector<surface_patch> patches;           ///< by their number
  local_id frozen = 0;                          ///< how many vertices never move; they come first
  double shortest_edge = 0.4, longest_edge = 2; ///< times the target; see `keeps_length`
  const any_sizing* field = nullptr;            ///< null or empty: sizes are those of the given mesh
  const surface_host* host = nullptr;           ///< null or empty: `given` is the host
  triangle_host given;

  bool inner(local_id v) const { return v >= frozen; } ///< whether a vertex may be moved
  /// Whether the vertex's patch is plane.
  bool is_plane(local_id v) const { return patches[patch[v]].is_plane; }

  // --- geometry of triangles ---

  /// Whether (a, b, c) turns left seen from the tip of the surface's normal, exactly, along the axis that is
  /// nearest to that normal. In a plane patch the axis is always the same: positive triangles do not overlap.
  bool positive(vec3 a, vec3 b, vec3 c, vec3 facing) const {
    const double x = std::abs(facing.x), y = std::abs(facing.y), z = std::abs(facing.z);
    if (z >= x && z >= y)
      return facing.z * turn({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) > 0;
    if (y >= x)
      return facing.y * turn({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) > 0;
    return facing.x * turn({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) > 0;
  }
  bool positive(local_id a, local_id b, local_id c) const {
    return positive(point[a], point[b], point[c], facing(a, b, c));
  }
  /// The `oriented_quality` of a triangle of three vertices (mesh/triangle_shape.hpp).
  double quality(local_id a, local_id b, local_id c) const {
    return dovetail::detail::oriented_quality(point[a], point[b], point[c], facing(a, b, c));
  }
  double quality(local_id t) const {
    return quality(table.vertex[3 * t], table.vertex[3 * t + 1], table.vertex[3 * t + 2]);
  }
  /// Cosine of the angle between the triangle's normal and the surface's.
  double agreement(local_id a, local_id b, local_id c) const {
    return agreement(point[a], point[b], point[c], facing(a, b, c));
  }

  /// The length of the edge between two vertices.
  double length(local_id a, local_id b) const { return distance(point[a], point[b]); }
  /// The length in sizes: the mean of those at the ends.
  double relative_length(local_id a, local_id b) const { return 2 * length(a, b) / (size[a] + size[b]); }

  // --- what operations may do ---

  /// Whether the opposite side of a corner may be flipped and both new triangles are positive.
  bool may_flip(local_id c) const {
    if (!table.free_side(c))
      return false;
    const local_id d = table.twin[c];
    const local_id p = table.vertex[c], q = table.vertex[d], a = table.tail(c), b = table.head(c);
    if (!positive(p, a, q) || !positive(q, b, p) || are_joined(p, q))
      return false;
    range lengths;
    for (const auto& [v, w] : {std::array{a, b}, {p, a}, {a, q}, {q, b}, {b, p}})
      lengths.include(relative_length(v, w));
    if (!keeps_length(relative_length(p, q), lengths))
      return false;
    return is_plane(a) || keeps_agreement(std::min(agreement(p, a, q), agreement(q, b, p)),
                                          std::min(agreement(p, a, b), agreement(q, b, a)));
  }

  /// May v move onto its neighbour w? Not when that joins two vertices twice or leaves the surface.
  bool may_collapse(local_id v, local_id w) const {
    bool is_allowed = true;
    double before = 1, after = 1;
    table.for_each_corner(v, [&](local_id c) {
      const local_id a = table.tail(c), b = table.head(c);
      before = std::min(before, agreement(v, a, b));
      if (!is_allowed || a == w || b == w)
        return;
      // a, the tail, is beside w in the ring when the triangle before has w.
      const bool is_beside = table.tail(table.clockwise(c)) == w;
      is_allowed = is_beside || !are_joined(a, w);
      after = std::min(after, agreement(w, a, b));
    });
    return is_allowed && (is_plane(v) || keeps_agreement(after, before));
  }

  /// Where v gets by a step along the surface, if its star stays valid and its edges keep their lengths.
  std::optional<location> displaced(local_id v, vec3 step,
                                    std::span<const std::array<local_id, 2>> link) const {
    const vec3 n = normal[v];
    const auto to = put_down(v, point[v] + (step - dot(step, n) * n));
    if (!to || to->point == point[v])
      return std::nullopt;
    range before, after;
    double agreed = 1, agrees = 1;
    for (const auto& [a, b] : link) {
      const vec3 pa = point[a], pb = point[b], faces = to->normal + normal[a] + normal[b];
      if (!positive(to->point, pa, pb, faces))
        return std::nullopt;
      if (!is_plane(v)) {
        agreed = std::min(agreed, agreement(v, a, b));
        agrees = std::min(agrees, agreement(to->point, pa, pb, faces));
      }
      before.include(relative_length(v, a));
      after.include(2 * distance(to->point, pa) / (size[v] + size[a]));
    }
    if (!keeps_length(after.least, before) || !keeps_length(after.most, before) ||
        !keeps_agreement(agrees, agreed))
      return std::nullopt;
    return to;
  }

  // --- changes ---

  /// All that a move of the vertex changes.
  location location_of(local_id v) const { return {point[v], normal[v], uv[v], on[v]}; }
  /// Moves a vertex.
  void place(local_id v, const location& where) {
    point[v] = where.point;
    normal[v] = where.normal;
    uv[v] = where.uv;
    on[v] = where.on;
  }
  /// A unit vector of the surface at v.
  vec3 tangent(local_id v) const {
    const vec3 n = normal[v];
    const vec3 least = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? vec3{1, 0, 0}
                       : std::abs(n.y) <= std::abs(n.z)                                 ? vec3{0, 1, 0}
                                                                                        : vec3{0, 0, 1};
    return normalized(cross(n, least));
  }

  /// A new vertex at the middle of the free side opposite c, or no_id when a half would be too short or the
  /// four triangles not valid. The caller splits the side.
  local_id add_middle(local_id c) {
    const local_id d = table.twin[c], a = table.tail(c), b = table.head(c);
    const local_id p = table.vertex[c], q = table.vertex[d];
    if (0.5 * relative_length(a, b) < shortest_edge)
      return no_id;
    const vec3 middle = midpoint(point[a], point[b]);
    const local_id v = add_vertex(inner(b) ? b : a);
    uv[v] = 0.5 * (uv[a] + uv[b]);
    if (const auto where = put_down(v, middle)) {
      place(v, *where);
      if (positive(p, a, v) && positive(b, p, v) && positive(q, b, v) && positive(a, q, v)) {
        size[v] = field != nullptr && *field ? checked_size(*field, where->point) : 0.5 * (size[a] + size[b]);
        return v;
      }
    }
    drop_last_vertex();
    return no_id;
  }
  /// Takes back the newest vertex, which no triangle may use any more.
  void drop_last_vertex() {
    table.corner_of.pop_back();
    point.pop_back();
    normal.pop_back();
    uv.pop_back();
    on.pop_back();
    patch.pop_back();
    source.pop_back();
    next_fan.pop_back();
    size.pop_back();
  }

  /// A list that operations may use while they run.
  std::vector<local_id>& ring_scratch() { return ring_; }

private:
  /// Triangles may turn away from the surface by 20 degrees, or as far as those they replace.
  static constexpr double enough_agreement = 0.94;

  struct range {
    double least = 1e300, most = 0;
    void include(double x) {
      least = std::min(least, x);
      most = std::max(most, x);
    }
  };

  vec3 facing(local_id a, local_id b, local_id c) const { return normal[a] + normal[b] + normal[c]; }
  static double turn(vec2 a, vec2 b, vec2 c) {
    const double value = orient2d(a, b, c);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  }
  static double agreement(vec3 a, vec3 b, vec3 c, vec3 facing) {
    const vec3 area = cross(b - a, c - a);
    const double lengths = std::sqrt(norm_squared(area) * norm_squared(facing));
    return lengths > 0 ? dot(area, facing) / lengths : -1;
  }
  static bool keeps_agreement(double after, double before) {
    return after >= std::min(enough_agreement, before);
  }
  /// An edge may not leave the band, unless others there were outside of it at least as far before.
  bool keeps_length(double relative, const range& before) const {
    return relative >= std::min(shortest_edge, before.least) &&
           relative <= std::max(longest_edge, before.most);
  }

  /// The place of vertex v on its host nearest p; nothing when the host fails there.
  std::optional<location> put_down(local_id v, vec3 p) const {
    location to = location_of(v);
    if (is_plane(v)) {
      to.point = p;
      return to;
    }
    host_point found;
    if (host != nullptr && *host)
      found = host->project(patches[patch[v]].tag, p, uv[v]);
    else
      found = given.project(p, to.on);
    if (!(norm_squared(found.normal) > 0) || !std::isfinite(norm_squared(found.point)))
      return std::nullopt;
    to.point = found.point;
    to.normal = found.normal;
    to.uv = found.uv;
    return to;
  }

  /// Appends a vertex that is all like v but has no triangles.
  local_id add_vertex(local_id like) {
    const local_id v = table.add_vertex();
    point.push_back(point[like]);
    normal.push_back(normal[like]);
    uv.push_back(uv[like]);
    on.push_back(on[like]);
    patch.push_back(patch[like]);
    source.push_back(no_id);
    next_fan.push_back(v);
    size.push_back(size[like]);
    return v;
  }

  /// Is there an edge between the points of v and w, in whatever patch? O(valence).
  bool are_joined(local_id v, local_id w) const {
    local_id fan = v;
    do {
      if (fan_reaches(fan, w))
        return true;
      fan = next_fan[fan];
    } while (fan != v);
    return false;
  }
  bool fan_reaches(local_id v, local_id w) const {
    const local_id first = table.corner_of[v];
    const auto reaches = [&](local_id c) { return is_at(table.tail(c), w) || is_at(table.head(c), w); };
    for (local_id c = first; c != no_id;) {
      if (reaches(c))
        return true;
      c = table.counter_clockwise(c);
      if (c == first)
        return false;
    }
    for (local_id c = first; c != no_id; c = table.clockwise(c))
      if (reaches(c))
        return true;
    return false;
  }
  bool is_at(local_id v, local_id w) const {
    return v == w || (source[v] != no_id && source[v] == source[w]);
  }

  std::vector<local_id> ring_;
};

/// Whether so many triangles are at a vertex that an operation on all of them costs more than it may bring:
/// the tip of a fan of thousands would be tried again by each of them.
inline bool has_large_star(const surface_complex& mesh, local_id v) {
  constexpr int most_triangles = 96;
  int count = 0;
  mesh.table.for_each_corner(v, [&](local_id) { ++count; });
  return count > most_triangles;
}

} // namespace dovetail::improvement
