/// @file
/// Corners in which two curves of a face run into each other, and what lies in them.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// A triangle on a face of the model.
struct face_triangle {
  simplex<2> vertices;
  local_id face;
};

/// The small angles between curves of the model's faces, as far as triangles show them. Far from a vertex
/// where two curves touch the face between them is as narrow as there.
class curve_corners {
public:
  /// \param points by vertex; they stay
  /// \param hosts by vertex, of the first ones; others are on no curve
  /// \param triangles of any faces
  /// \param small_deg an angle between curves is small below that
  curve_corners(std::span<const vec3> points, std::vector<host> hosts,
                std::span<const face_triangle> triangles, double small_deg)
      : points_(points), hosts_(std::move(hosts)) {
    std::vector<turn> turns;
    for (const face_triangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (is_model_vertex(t.vertices[k]))
          turns.push_back({t.vertices[k], t.face, {t.vertices[(k + 1) % 3], t.vertices[(k + 2) % 3]}});
    sort_all(turns, [](const turn& a, const turn& b) {
      return std::pair(a.vertex, a.face) < std::pair(b.vertex, b.face);
    });
    for (auto first = turns.begin(), last = first; first != turns.end(); first = last) {
      last = std::find_if(first, turns.end(),
                          [&](const turn& t) { return t.vertex != first->vertex || t.face != first->face; });
      for (const fan& one : fans_of({first, last}))
        add_ends(one, small_deg);
    }
    sort_unique(corners_);
    if (!corners_.empty())
      mark(triangles);
  }

  /// Whether two of the vertices, one on each of two curves that meet in a corner, are no further apart than
  /// a share of the largest distance between vertices, or one is between such curves.
  bool hold(std::span<const local_id> vertices, double share) const {
    if (corners_.empty())
      return false;
    double largest = 0;
    for (const local_id u : vertices)
      for (const local_id v : vertices)
        largest = std::max(largest, distance(points_[u], points_[v]));
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t j = i; j < vertices.size(); ++j) {
        const local_id u = vertices[i], v = vertices[j];
        if ((i != j || is_inside(u)) && distance(points_[u], points_[v]) <= share * largest &&
            meet(marks_of(u), marks_of(v)))
          return true;
      }
    return false;
  }

private:
  using mark_list = std::vector<std::pair<local_id, local_id>>; ///< vertex, curve; sorted

  /// A corner of a triangle at a vertex of the model.
  struct turn {
    local_id vertex, face;
    std::array<local_id, 2> others;
  };
  /// Triangles around a vertex that have sides in common.
  struct fan {
    local_id vertex;
    double degrees = 0;
    std::vector<local_id> ends; ///< those of an inner side twice
  };

  bool is_model_vertex(local_id v) const {
    return v < static_cast<local_id>(hosts_.size()) && hosts_[v].dimension == 0;
  }
  local_id curve_of(local_id v) const {
    return v < static_cast<local_id>(hosts_.size()) && hosts_[v].dimension == 1 ? hosts_[v].id : no_id;
  }

  bool is_inside(local_id v) const { return curve_of(v) == no_id && !is_model_vertex(v); }

  std::vector<fan> fans_of(std::span<const turn> turns) const {
    std::vector<fan> fans;
    for (const turn& t : turns) {
      const vec3 p = points_[t.vertex];
      fan joined{t.vertex,
                 degrees_per_radian * angle_between(points_[t.others[0]] - p, points_[t.others[1]] - p),
                 {t.others[0], t.others[1]}};
      std::erase_if(fans, [&](const fan& other) {
        const bool is_beside = std::any_of(other.ends.begin(), other.ends.end(),
                                           [&](local_id v) { return v == t.others[0] || v == t.others[1]; });
        if (is_beside) {
          joined.degrees += other.degrees;
          append(joined.ends, other.ends);
        }
        return is_beside;
      });
      fans.push_back(std::move(joined));
    }
    return fans;
  }

  /// The curves at the two sides of a fan meet in a corner, if it is small; else the vertex is beside each.
  void add_ends(fan one, double small_deg) {
    std::sort(one.ends.begin(), one.ends.end());
    std::vector<local_id> curves;
    for (const local_id v : one.ends)
      if (curve_of(v) != no_id && std::count(one.ends.begin(), one.ends.end(), v) == 1)
        curves.push_back(curve_of(v));
    if (one.degrees < small_deg && curves.size() == 2 && curves[0] != curves[1])
      corners_.push_back(std::minmax(curves[0], curves[1]));
    else
      for (const local_id c : curves)
        marks_.push_back({one.vertex, c});
  }

  /// Vertices are beside the curves that they are on; those inside of a face, and joined there to two at most
  /// that are on none, are beside the curves of the others.
  void mark(std::span<const face_triangle> triangles) {
    constexpr std::ptrdiff_t most_beside = 2;
    for (local_id v = 0; v < static_cast<local_id>(hosts_.size()); ++v)
      if (curve_of(v) != no_id)
        marks_.push_back({v, curve_of(v)});
    std::vector<local_id> curves;
    for (const auto& pair : corners_)
      curves.insert(curves.end(), {pair.first, pair.second});
    sort_unique(curves);
    std::erase_if(
        marks_, [&](const auto& at) { return !std::binary_search(curves.begin(), curves.end(), at.second); });
    sort_unique(marks_);
    mark_list beside, inside;
    for (const face_triangle& t : triangles)
      for (const local_id v : t.vertices)
        for (const local_id other : t.vertices) {
          if (v == other || !is_inside(v))
            continue;
          if (const auto at = marks_of(other); !at.empty())
            for (const auto& one : at)
              beside.push_back({v, one.second});
          else if (is_inside(other))
            inside.push_back({v, other});
        }
    sort_unique(inside);
    for (const auto& [v, curve] : beside)
      if (static_cast<std::ptrdiff_t>(marks_of(v, inside).size()) <= most_beside)
        marks_.push_back({v, curve});
    sort_unique(marks_);
  }

  std::span<const std::pair<local_id, local_id>> marks_of(local_id v) const { return marks_of(v, marks_); }
  static std::span<const std::pair<local_id, local_id>> marks_of(local_id v, const mark_list& marks) {
    const auto first = std::lower_bound(marks.begin(), marks.end(), std::pair(v, no_id));
    return {first, std::find_if(first, marks.end(), [&](const auto& at) { return at.first != v; })};
  }

  bool meet(std::span<const std::pair<local_id, local_id>> first,
            std::span<const std::pair<local_id, local_id>> second) const {
    for (const auto& a : first)
      for (const auto& b : second)
        if (std::binary_search(corners_.begin(), corners_.end(),
                               std::pair<local_id, local_id>(std::minmax(a.second, b.second))))
          return true;
    return false;
  }

  std::span<const vec3> points_;
  std::vector<host> hosts_;
  std::vector<std::pair<local_id, local_id>> corners_; ///< curves that meet in one; the lower one first
  mark_list marks_;
};

} // namespace dovetail::detail
