/// @file
/// A smooth surface through the points of a triangulated one: on every triangle a cubic map whose edges are
/// arcs that leave their ends along the tangent planes there, or along the feature curve that they are on
/// (after A. Vlachos, J. Peters, C. Boyd, J. Mitchell, Curved PN triangles, I3D 2001; their edges have the
/// right tangents and are too flat, ours have the height of an arc). Between triangles it is continuous.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/nearest_point.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/models/discrete/smooth_areas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// A triangle, and how far the control points of its cubic map are from where a plane one has them.
struct curved_triangle {
  std::array<vec3, 3> corners;              ///< the corners of the plane triangle
  std::array<std::array<vec3, 2>, 3> along; ///< at corner i: towards corners i + 1 and i + 2
  vec3 inner; ///< what is added inside, times six times the product of the barycentric coordinates
};

/// Makes the triangles of a surface curved. `smooth_of`: the smooth area of each triangle, between which are
/// feature edges. O(n log n).
class triangle_curving {
public:
  triangle_curving(const simplicial_mesh<2>& mesh, const std::vector<local_id>& smooth_of)
      : mesh_(mesh), smooth_of_(smooth_of), sides_(build_sides<2>(mesh)) {
    find_normals();
    find_tangents();
  }

  /// All triangles, curved, in their order.
  std::vector<curved_triangle> run() const {
    std::vector<curved_triangle> made;
    for (std::size_t t = 0; t < mesh_.elements.size(); ++t)
      made.push_back(curved(t));
    return made;
  }

private:
  /// How far a normal is to be believed: of a closed fan of triangles, of an open one, of a sharp tip.
  enum class trust { none, one_sided, full };
  struct vertex_normal {
    local_id vertex;
    local_id area;
    vec3 normal;
    trust believed;
  };

  static constexpr double widest_fan = 35 * radians_per_degree;   ///< between a normal and its triangles'
  static constexpr double sharp_corner = 40 * radians_per_degree; ///< feature curves end where they turn more

  vec3 point(local_id v) const { return mesh_.points[v]; }

  bool is_feature(std::size_t side) const {
    const auto& [a, b] = sides_.elements[side];
    return !sides_.is_interior(static_cast<local_id>(side)) || smooth_of_[a] != smooth_of_[b];
  }

  /// Normals by the weights of N. Max (J. Graphics Tools 4, 1999), which are exact where points lie on a
  /// sphere.
  void find_normals() {
    struct corner {
      local_id vertex;
      local_id area;
      std::size_t triangle;
      vec3 weighted;
    };
    std::vector<corner> corners;
    for (std::size_t t = 0; t < mesh_.elements.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& v = mesh_.elements[t];
        const vec3 a = point(v[(i + 1) % 3]) - point(v[i]);
        const vec3 b = point(v[(i + 2) % 3]) - point(v[i]);
        const double weight = norm_squared(a) * norm_squared(b);
        corners.push_back({v[i], smooth_of_[t], t, weight > 0 ? cross(a, b) / weight : vec3{}});
      }
    std::sort(corners.begin(), corners.end(), [](const corner& a, const corner& b) {
      return std::tie(a.vertex, a.area, a.triangle) < std::tie(b.vertex, b.area, b.triangle);
    });
    std::vector<char> on_feature(mesh_.points.size(), 0);
    for (std::size_t s = 0; s < sides_.size(); ++s)
      if (is_feature(s))
        for (const local_id v : sides_.vertices[s])
          on_feature[v] = 1;
    for (std::size_t first = 0, last = 0; first < corners.size(); first = last) {
      const corner& of = corners[first];
      vertex_normal made{of.vertex, of.area, {}, trust::full};
      for (; last < corners.size() && corners[last].vertex == of.vertex && corners[last].area == of.area;
           ++last)
        made.normal += corners[last].weighted;
      made.normal = normalized(made.normal);
      if (on_feature[of.vertex])
        made.believed = trust::one_sided;
      for (std::size_t k = first; k < last; ++k)
        if (norm(corners[k].weighted) > 0 && angle_between(corners[k].weighted, made.normal) > widest_fan)
          made.believed = trust::none;
      normals_.push_back(made);
    }
  }

  const vertex_normal& normal_at(local_id vertex, local_id area) const {
    return *std::lower_bound(
        normals_.begin(), normals_.end(), std::pair(vertex, area),
        [](const vertex_normal& n, const auto& wanted) { return std::pair(n.vertex, n.area) < wanted; });
  }

  /// Of feature curves, at vertices where one goes on without a corner; in no particular direction.
  void find_tangents() {
    std::vector<std::array<local_id, 2>> from; // vertex, and its neighbour on a feature
    for (std::size_t s = 0; s < sides_.size(); ++s)
      if (is_feature(s)) {
        const auto& [a, b] = sides_.vertices[s];
        from.push_back({a, b});
        from.push_back({b, a});
      }
    std::sort(from.begin(), from.end());
    tangents_.assign(mesh_.points.size(), {});
    for (std::size_t first = 0, last = 0; first < from.size(); first = last) {
      while (last < from.size() && from[last][0] == from[first][0])
        ++last;
      if (last - first != 2)
        continue;
      const vec3 before = point(from[first][0]) - point(from[first][1]);
      const vec3 after = point(from[first + 1][1]) - point(from[first][0]);
      if (angle_between(before, after) > sharp_corner)
        continue;
      // Of the circle through the three points.
      tangents_[from[first][0]] = normalized(before / norm_squared(before) + after / norm_squared(after));
    }
  }

  /// The control point near a of an arc from a to b that leaves a along `tangent`: from where it would be on
  /// the chord. Nothing for tangents that lead elsewhere.
  static vec3 bulge(vec3 chord, vec3 tangent) {
    const double length = norm(chord);
    if (!(length > 0))
      return {};
    const vec3 c = chord / length;
    const double cosine = dot(tangent, c);
    if (cosine < 0.5)
      return {};
    return (2 * length / (3 * (1 + cosine))) * (tangent - cosine * c);
  }
  static vec3 mirrored(vec3 direction, vec3 chord) {
    return direction - (2 * dot(direction, chord) / norm_squared(chord)) * chord;
  }

  vec3 bulge_on_feature(local_id a, local_id b) const {
    const vec3 chord = point(b) - point(a);
    const auto towards_b = [&](vec3 t) { return dot(t, chord) < 0 ? -t : t; };
    const vec3 here = tangents_[a];
    if (norm_squared(here) > 0)
      return bulge(chord, towards_b(here));
    const vec3 there = tangents_[b];
    return norm_squared(there) > 0 ? bulge(chord, -mirrored(towards_b(there), chord)) : vec3{};
  }

  /// An end whose normal is worse known takes the other's, as the arc between them would have it.
  vec3 bulge_inside(local_id a, local_id b, local_id area) const {
    const vec3 chord = point(b) - point(a);
    const vertex_normal& here = normal_at(a, area);
    const vertex_normal& there = normal_at(b, area);
    if (std::max(here.believed, there.believed) == trust::none || !(norm_squared(chord) > 0))
      return {};
    const vec3 n = here.believed < there.believed ? mirrored(there.normal, chord) : here.normal;
    const vec3 tangent = chord - dot(chord, n) * n;
    return norm_squared(tangent) > 0 ? bulge(chord, normalized(tangent)) : vec3{};
  }

  curved_triangle curved(std::size_t t) const {
    const auto& v = mesh_.elements[t];
    curved_triangle made{{point(v[0]), point(v[1]), point(v[2])}, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) { // the edge opposite corner k
      const std::size_t side = sides_.of_element[t][k];
      const std::size_t i = (k + 1) % 3;
      const std::size_t j = (k + 2) % 3;
      const auto d = [&](local_id a, local_id b) {
        return is_feature(side) ? bulge_on_feature(a, b) : bulge_inside(a, b, smooth_of_[t]);
      };
      made.along[i][0] = d(v[i], v[j]);
      made.along[j][1] = d(v[j], v[i]);
      made.inner += 0.25 * (made.along[i][0] + made.along[j][1]);
    }
    return made;
  }

  const simplicial_mesh<2>& mesh_;
  const std::vector<local_id>& smooth_of_;
  side_table<2> sides_;
  std::vector<vertex_normal> normals_; ///< by vertex and area
  std::vector<vec3> tangents_;         ///< per vertex, or zero
};

/// How far, and where to, the smooth surface is from points of the triangulated one. Queries are const,
/// thread-safe, O(log n).
class curved_triangles {
public:
  explicit curved_triangles(std::vector<curved_triangle> triangles) : triangles_(std::move(triangles)) {
    std::vector<box3> boxes(triangles_.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
      for (const vec3& p : triangles_[t].corners)
        boxes[t].include(p);
    tree_ = box_tree(boxes);
  }

  /// From a point of the triangulated surface (or from the one nearest to a point beside it) to the smooth
  /// one, and how that changes along given directions.
  struct lift {
    vec3 to;                    ///< from the point to the smooth surface
    std::array<vec3, 2> change; ///< of `to`, along each of the two directions
  };
  /// The lift of a point, and its change along `du` and `dv`.
  lift at(vec3 p, vec3 du = {}, vec3 dv = {}) const {
    const auto& triangle = triangles_[nearest(p)];
    const auto& corners = triangle.corners; // named, since clang 14 captures no structured binding
    const vec3& inner = triangle.inner;
    const auto b = nearest_on_triangle(corners[0], corners[1], corners[2], p);
    lift result{6 * b[0] * b[1] * b[2] * inner, {}};
    std::array<vec3, 3> slope{6 * b[1] * b[2] * inner, 6 * b[2] * b[0] * inner, 6 * b[0] * b[1] * inner};
    for (std::size_t i = 0; i < 3; ++i)
      for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) { // the control point a third of the way to j
        const vec3& d = triangle.along[i][j == (i + 1) % 3 ? 0 : 1];
        result.to += 3 * b[i] * b[i] * b[j] * d;
        slope[i] += 6 * b[i] * b[j] * d;
        slope[j] += 3 * b[i] * b[i] * d;
      }
    const vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double squared = norm_squared(n);
    const auto rate = [&](std::size_t i, vec3 direction) { // of the i-th barycentric coordinate
      return dot(cross(n, corners[(i + 2) % 3] - corners[(i + 1) % 3]), direction) / squared;
    };
    for (std::size_t i = 0; i < 3 && squared > 0; ++i) {
      result.change[0] += rate(i, du) * slope[i];
      result.change[1] += rate(i, dv) * slope[i];
    }
    return result;
  }

  /// No point is farther from its triangle.
  double height() const {
    double most = 0;
    for (const auto& t : triangles_)
      for (const auto& pair : t.along)
        for (const vec3& d : pair)
          most = std::max(most, norm(d));
    return 2 * most;
  }

private:
  std::size_t nearest(vec3 p) const {
    double best = std::numeric_limits<double>::infinity();
    std::size_t found = 0;
    tree_.for_each_near(
        p, [&](const box3& box, std::size_t) { return distance_squared(box, p) <= best; },
        [&](local_id id) {
          const auto& [a, b, c] = triangles_[id].corners;
          const auto w = nearest_on_triangle(a, b, c, p);
          const double away = norm_squared(w[0] * a + w[1] * b + w[2] * c - p);
          if (away < best || (away == best && static_cast<std::size_t>(id) < found)) {
            best = away;
            found = static_cast<std::size_t>(id);
          }
        });
    return found;
  }

  std::vector<curved_triangle> triangles_;
  box_tree tree_;
};

} // namespace dovetail::discrete
