/// @file
/// What `shared_contacts.hpp` declares.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/mesh/inside_surface.hpp"
#include "dovetail/mesh/triangle_intersection.hpp"
#include "dovetail/models/shared_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// A lower bound of the distance of two triangles: what separates them along the normals of one of them, of
/// its edges, or of two edges, one of each.
inline double separation(const std::array<vec3, 3>& s, const std::array<vec3, 3>& t) {
  double best = 0;
  const auto try_axis = [&](vec3 axis) {
    const double length = norm(axis);
    if (!(length > 0))
      return;
    const auto range = [&](const std::array<vec3, 3>& corners) {
      return std::minmax({dot(axis, corners[0]), dot(axis, corners[1]), dot(axis, corners[2])});
    };
    const auto [s_low, s_high] = range(s);
    const auto [t_low, t_high] = range(t);
    best = std::max(best, std::max(t_low - s_high, s_low - t_high) / length);
  };
  const auto edge = [](const std::array<vec3, 3>& corners, std::size_t k) {
    return corners[(k + 1) % 3] - corners[k];
  };
  for (const auto* triangle : {&s, &t}) {
    const vec3 normal = cross(edge(*triangle, 0), edge(*triangle, 1));
    try_axis(normal);
    for (std::size_t k = 0; k < 3; ++k)
      try_axis(cross(normal, edge(*triangle, k)));
  }
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 3; ++l) {
      try_axis(cross(edge(s, k), edge(t, l)));
      try_axis(t[l] - s[k]);
    }
  return best;
}

/// Looks for contacts of bodies that they do not share.
class contact_search {
public:
  contact_search(const surface_mesh& surface, const geometry_topology& topology)
      : mesh_(surface.mesh), topology_(topology) {
    for (const auto& triangle : mesh_.elements) {
      box3& box = boxes_.emplace_back();
      for (const vec3 corner : corners(triangle))
        box.include(corner);
    }
  }

  double least_distance(double within) const {
    const box_tree tree(boxes_);
    double least = within;
    bool found = false;
    for (std::size_t s = 0; s < boxes_.size(); ++s)
      tree.for_each([&](const box3& box, std::size_t) { return distance(box, boxes_[s]) <= least; },
                    [&](local_id other) {
                      const auto t = static_cast<std::size_t>(other);
                      if (t <= s || !are_compared(s, t) || distance(boxes_[t], boxes_[s]) > least)
                        return;
                      const double apart = distance_of(s, t);
                      found = found || apart <= least;
                      least = std::min(least, apart);
                    });
    return found ? least : std::numeric_limits<double>::infinity();
  }

  /// Whether a solid has another body inside. Bodies whose triangles do not touch are inside or outside as a
  /// whole: one point tells.
  bool finds_body_inside() const {
    for (std::size_t solid = 0; solid < topology_.solids.size(); ++solid)
      if (has_body_inside(static_cast<local_id>(solid)))
        return true;
    return false;
  }

private:
  using pair_of_solids = std::array<local_id, 2>;

  std::array<vec3, 3> corners(const simplex<2>& triangle) const {
    return {mesh_.points[triangle[0]], mesh_.points[triangle[1]], mesh_.points[triangle[2]]};
  }
  const pair_of_solids& solids_of(std::size_t triangle) const {
    return topology_.faces[mesh_.tags[triangle]].solids;
  }
  static bool bounds(const pair_of_solids& solids, local_id solid) {
    return solid != no_id && (solids[0] == solid || solids[1] == solid);
  }

  /// Triangles of one body are left alone, as are two faces that are in no solid.
  bool are_compared(std::size_t s, std::size_t t) const {
    const pair_of_solids& a = solids_of(s);
    const pair_of_solids& b = solids_of(t);
    return (a[0] != no_id || b[0] != no_id) && !bounds(b, a[0]) && !bounds(b, a[1]);
  }

  double distance_of(std::size_t s, std::size_t t) const {
    const simplex<2>& a = mesh_.elements[s];
    const simplex<2>& b = mesh_.elements[t];
    const auto shared = std::count_if(
        a.begin(), a.end(), [&](local_id v) { return std::find(b.begin(), b.end(), v) != b.end(); });
    if (shared == 0)
      return separation(corners(a), corners(b));
    const bool meet = triangles_cross(mesh_.points, a, b) || (shared == 2 && lie_on_each_other(a, b));
    return meet ? 0 : std::numeric_limits<double>::infinity();
  }

  /// Of two triangles at an edge, whether the angle between them is so small that curved faces may touch.
  bool lie_on_each_other(const simplex<2>& a, const simplex<2>& b) const {
    constexpr double least_cosine = 0.98; // 11 degrees
    std::array<local_id, 2> ends{no_id, no_id};
    local_id tip_a = no_id;
    for (const local_id v : a)
      if (std::find(b.begin(), b.end(), v) == b.end())
        tip_a = v;
      else
        (ends[0] == no_id ? ends[0] : ends[1]) = v;
    const local_id tip_b =
        *std::find_if(b.begin(), b.end(), [&](local_id v) { return v != ends[0] && v != ends[1]; });
    const vec3 along = normalized(mesh_.points[ends[1]] - mesh_.points[ends[0]]);
    const auto upright = [&](local_id tip) {
      const vec3 there = mesh_.points[tip] - mesh_.points[ends[0]];
      return there - dot(there, along) * along;
    };
    const vec3 u = upright(tip_a), v = upright(tip_b);
    return !(dot(u, v) < least_cosine * norm(u) * norm(v));
  }

  bool has_body_inside(local_id solid) const {
    simplicial_mesh<2> own;
    own.points = mesh_.points;
    std::vector<char> is_own(mesh_.points.size(), 0);
    box3 box;
    for (std::size_t t = 0; t < mesh_.elements.size(); ++t) {
      const pair_of_solids& solids = solids_of(t);
      if (!bounds(solids, solid) || solids[0] == solids[1])
        continue;
      own.elements.push_back(mesh_.elements[t]);
      for (const local_id v : mesh_.elements[t]) {
        is_own[v] = 1;
        box.include(mesh_.points[v]);
      }
    }
    std::optional<inside_surface> inside;
    for (const vec3 p : points_of_others(solid, is_own)) {
      if (!contains(box, p))
        continue;
      if (!inside)
        inside.emplace(std::move(own));
      if ((*inside)(p))
        return true;
    }
    return false;
  }

  /// Of each other body a point that is not on the solid: a corner that they do not share, else the middle of
  /// a triangle. A body all of whose faces are the solid's fills a void of it, and has none.
  std::vector<vec3> points_of_others(local_id solid, const std::vector<char>& is_own) const {
    std::vector<std::optional<vec3>> corner(topology_.solids.size() + topology_.faces.size());
    auto middle = corner;
    for (std::size_t t = 0; t < mesh_.elements.size(); ++t) {
      const pair_of_solids& solids = solids_of(t);
      if (bounds(solids, solid))
        continue;
      const auto [a, b, c] = corners(mesh_.elements[t]);
      const auto note = [&](std::size_t body) {
        if (!middle[body])
          middle[body] = (a + b + c) / 3;
        for (const local_id v : mesh_.elements[t])
          if (!corner[body] && is_own[v] == 0)
            corner[body] = mesh_.points[v];
      };
      for (const local_id other : solids)
        if (other != no_id)
          note(static_cast<std::size_t>(other));
      if (solids[0] == no_id)
        note(topology_.solids.size() + static_cast<std::size_t>(mesh_.tags[t]));
    }
    std::vector<vec3> points;
    for (std::size_t body = 0; body < corner.size(); ++body)
      if (const auto& p = corner[body] ? corner[body] : middle[body])
        points.push_back(*p);
    return points;
  }

  const simplicial_mesh<2>& mesh_;
  const geometry_topology& topology_;
  std::vector<box3> boxes_; ///< per triangle
};

} // namespace detail

DOVETAIL_INLINE double unshared_distance(const surface_mesh& surface, const geometry_topology& topology,
                                         double within) {
  return detail::contact_search(surface, topology).least_distance(within);
}

DOVETAIL_INLINE bool has_body_inside_another(const surface_mesh& surface, const geometry_topology& topology) {
  return detail::contact_search(surface, topology).finds_body_inside();
}

} // namespace dovetail
