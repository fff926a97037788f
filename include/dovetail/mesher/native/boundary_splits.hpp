/// @file
/// Points put on edges and triangles that are not recovered otherwise, and taken off them again.
///
/// A point where a missing edge or triangle meets what is in its way divides it into smaller ones, until all
/// of these are there. Then the points are taken off the boundary, the last first: the elements at one are
/// exchanged for others on each side of the triangles it divided, which are whole again, with a point on
/// either side in its place, if any. (The idea is that of points on the boundary which are "dropped" inwards,
/// in N. P. Weatherill and O. Hassan, doi 10.1002/nme.1620371203, and George et al., doi 10.1002/nme.808;
/// here one that sees all of its part is found by a linear program.)
#pragma once

#include "dovetail/core/number_text.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/native/kept_entities.hpp"
#include "dovetail/mesher/native/recovery_targets.hpp"
#include "dovetail/mesher/native/region_growth.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The points on the boundary, in the order in which they came.
class boundary_splits {
public:
  boundary_splits(local_changes& changes, kept_entities& kept)
      : changes_(changes), kept_(kept), growth_(changes, kept) {}

  std::size_t count() const { return splits_.size(); }
  /// Whether a vertex is one of them.
  bool has_point(local_id v) const {
    return std::any_of(splits_.begin(), splits_.end(), [v](const split_record& s) { return s.point == v; });
  }
  std::string place_of_last() const {
    return (splits_.back().parent_edge[0] == no_id ? "a triangle at " : "an edge at ") +
           place_text(changes_.point(splits_.back().point));
  }

  /// Divides an edge, or a triangle whose edges are there, where it meets something in its way. Adds the
  /// edges that are to be there then. False, and nothing has changed, when there is no good place.
  template <class Target>
  bool split(const Target& target, const obstacles& found, std::vector<edge_target>& fresh_edges) {
    places_.clear();
    find_places(target, found);
    // What is computed of flat triangles may be nonsense; the middle is not.
    add_place(target.middle(changes_), 0, elements_at(target, target.middle(changes_)));
    stable_sort_all(places_, [](const place& a, const place& b) { return a.value > b.value; });
    for (const place& where : places_)
      if (const local_id s = growth_.insert(where.point, where.elements); s != no_id) {
        divide(target, s, fresh_edges);
        return true;
      }
    return false;
  }

  /// Takes all points off the boundary, the last ones first, as far as possible; those that stay are counted.
  /// `make_room(s)` shall change something around a point that stays, or return false. `thorough`: more is
  /// tried for each.
  template <class MakeRoom>
  std::size_t undo_all(const MakeRoom& make_room, bool thorough) {
    is_thorough_ = thorough;
    for (bool any = true; any && !splits_.empty();) {
      any = false;
      for (std::size_t k = splits_.size(); k-- > 0 && !changes_.is_spent();)
        if (is_last_there(splits_[k]) && (undo(k) || (make_room(splits_[k].point) && undo(k))))
          any = true;
    }
    return splits_.size();
  }

private:
  struct split_record {
    local_id point;
    vertex_pair parent_edge{no_id, no_id};
    std::vector<simplex<2>> parents;  ///< triangles that the point divides
    std::vector<simplex<2>> children; ///< `per_parent` for each of them, oriented as it is
    std::size_t per_parent;
    std::vector<vertex_pair> edges; ///< those of the children at the point
  };
  struct place {
    vec3 point;
    double value; ///< how far from the ends of all that is divided there, at most 1
    std::vector<local_id> elements;
  };

  /// Where segments (a, b) and (u, v) in one plane cross, as fractions of both.
  static std::array<double, 2> crossing(vec3 a, vec3 b, vec3 u, vec3 v) {
    const vec3 d = b - a, e = v - u, r = u - a;
    const vec3 normal = cross(d, e);
    const double square = dot(normal, normal);
    return {dot(cross(r, e), normal) / square, dot(cross(r, d), normal) / square};
  }
  /// Where a line from a to b passes through the plane of (u, v, w): the fraction, and the smallest of the
  /// point's barycentric coordinates times 3.
  static std::array<double, 2> piercing(vec3 a, vec3 b, vec3 u, vec3 v, vec3 w) {
    const vec3 normal = cross(v - u, w - u);
    const double da = dot(normal, a - u), db = dot(normal, b - u);
    const double t = da / (da - db);
    const vec3 p = a + t * (b - a);
    const double square = dot(normal, normal) / 3;
    return {t, std::min({dot(normal, cross(v - p, w - p)), dot(normal, cross(w - p, u - p)),
                         dot(normal, cross(u - p, v - p))}) /
                   square};
  }
  static double middleness(double t) { return 2 * std::min(t, 1 - t); }
  void add_place(vec3 p, double value, std::vector<local_id> elements) {
    if (std::isfinite(p.x + p.y + p.z) && !elements.empty())
      places_.push_back({p, value > 0 ? std::min(value, 1.0) : 0, std::move(elements)});
  }
  std::vector<local_id> ring_of(local_id u, local_id v) {
    const local_id e = kept_.has(u, v) ? no_id : changes_.element_with_edge(u, v);
    if (e == no_id)
      return {};
    constexpr std::size_t most_ring = 100;
    edge_ring ring;
    changes_.find_ring(e, u, v, most_ring, ring);
    return ring.elements;
  }

  /// Elements along a target that hold a point.
  template <class Target>
  std::vector<local_id> elements_at(const Target& target, vec3 p) {
    std::vector<local_id> result;
    for_each_along(changes_, target, [&](local_id e) {
      for (std::size_t i = 0; i < 4; ++i) {
        const auto [u, v, w] = changes_.side_vertices(e, i);
        if (changes_.orientation(p, u, v, w) < 0)
          return;
      }
      result.push_back(e);
    });
    return result;
  }

  void find_places(const edge_target& target, const obstacles& found) {
    const vec3 a = changes_.point(target.ends[0]), b = changes_.point(target.ends[1]);
    for (const auto& [u, v] : found.edges)
      if (auto elements = ring_of(u, v); !elements.empty()) {
        const auto [t, along] = crossing(a, b, changes_.point(u), changes_.point(v));
        add_place(a + t * (b - a), middleness(t) * middleness(along), std::move(elements));
      }
    for (const local_id side : found.sides) {
      const local_id e = triangulation<3>::element_of(side);
      const auto s = changes_.side_vertices(e, triangulation<3>::place_of(side));
      if (kept_.has(s[0], s[1], s[2]))
        continue;
      const auto [t, within] =
          piercing(a, b, changes_.point(s[0]), changes_.point(s[1]), changes_.point(s[2]));
      add_place(a + t * (b - a), middleness(t) * within,
                {e, triangulation<3>::element_of(changes_.mesh().across(side))});
    }
  }
  void find_places(const triangle_target& target, const obstacles& found) {
    for (const auto& [u, v] : found.edges)
      if (auto elements = ring_of(u, v); !elements.empty()) {
        const vec3 pu = changes_.point(u), pv = changes_.point(v);
        const auto [t, within] =
            piercing(pu, pv, changes_.point(target.corners[0]), changes_.point(target.corners[1]),
                     changes_.point(target.corners[2]));
        add_place(pu + t * (pv - pu), middleness(t) * within, std::move(elements));
      }
  }

  void divide(const edge_target& target, local_id s, std::vector<edge_target>& fresh_edges) {
    const auto [a, b] = target.ends;
    split_record record{s, sorted_pair(a, b), kept_.triangles_at(a, b), {}, 2, {{a, s}, {s, b}}};
    for (simplex<2> t : record.parents) {
      while ((t[0] != a || t[1] != b) && (t[0] != b || t[1] != a))
        std::rotate(t.begin(), t.begin() + 1, t.end());
      record.children.push_back({t[0], s, t[2]});
      record.children.push_back({s, t[1], t[2]});
      record.edges.push_back({s, t[2]});
    }
    sort_unique(record.edges);
    kept_.set_edge(a, b, false);
    keep(std::move(record), fresh_edges);
  }
  void divide(const triangle_target& target, local_id s, std::vector<edge_target>& fresh_edges) {
    const auto [a, b, c] = target.corners;
    keep(
        {s, {no_id, no_id}, {target.corners}, {{a, b, s}, {b, c, s}, {c, a, s}}, 3, {{a, s}, {b, s}, {c, s}}},
        fresh_edges);
  }
  void keep(split_record record, std::vector<edge_target>& fresh_edges) {
    for (const auto& triangle : record.parents)
      kept_.set_triangle(triangle, false);
    for (const auto& triangle : record.children)
      kept_.set_triangle(triangle, true);
    for (const auto& [u, v] : record.edges) {
      kept_.set_edge(u, v, true);
      fresh_edges.push_back({{u, v}});
    }
    splits_.push_back(std::move(record));
  }

  /// Exchanges the elements at the point of a split for others that have the triangles it divided.
  bool refill(const split_record& split) {
    changes_.find_star(split.point, star_);
    disjoint_sets parts(star_.size());
    std::vector<std::pair<simplex<2>, local_id>> inner; // sides at the point, of which element
    for (std::size_t k = 0; k < star_.size(); ++k)
      for (std::size_t i = 0; i < 4; ++i)
        if (changes_.mesh()[star_[k]].vertices[i] != split.point)
          inner.push_back({changes_.side_vertices(star_[k], i), static_cast<local_id>(k)});
    sort_all(inner, [](const auto& a, const auto& b) {
      return sorted_vertices(a.first) < sorted_vertices(b.first);
    });
    // Per parent and direction: the part it closes, and how many of its children were seen from there.
    struct closing {
      local_id element = no_id;
      std::size_t children = 0;
    };
    std::vector<std::array<closing, 2>> closings(split.parents.size());
    for (std::size_t k = 0; k + 1 < inner.size(); k += 2) {
      const auto key = sorted_vertices(inner[k].first);
      const auto child = std::find_if(split.children.begin(), split.children.end(),
                                      [&](const simplex<2>& t) { return sorted_vertices(t) == key; });
      if (child == split.children.end()) {
        parts.unite(inner[k].second, inner[k + 1].second);
        continue;
      }
      const auto parent = static_cast<std::size_t>(child - split.children.begin()) / split.per_parent;
      for (const auto& [side, element] : {inner[k], inner[k + 1]}) {
        closing& c = closings[parent][boundary_sides::parity(side) == boundary_sides::parity(*child) ? 0 : 1];
        c.element = element;
        ++c.children;
      }
    }
    const auto numbered = parts.number_sets();
    std::vector<std::vector<local_id>> elements(numbered.count);
    std::vector<std::vector<simplex<2>>> closed_by(numbered.count);
    for (std::size_t k = 0; k < star_.size(); ++k)
      elements[numbered.of_member[k]].push_back(star_[k]);
    for (std::size_t p = 0; p < closings.size(); ++p)
      for (std::size_t direction = 0; direction < 2; ++direction) {
        const closing& c = closings[p][direction];
        if (c.children != split.per_parent)
          return false;
        const auto& [u, v, w] = split.parents[p];
        closed_by[numbered.of_member[c.element]].push_back(direction == 0 ? simplex<2>{u, v, w}
                                                                          : simplex<2>{u, w, v});
      }
    const std::size_t points = changes_.mesh().points.size();
    std::vector<local_id> old;
    fresh_.clear();
    for (std::size_t k = 0; k < elements.size(); ++k)
      if (!growth_.refill(elements[k], split.point, closed_by[k], old, fresh_, is_thorough_)) {
        changes_.drop_points(points);
        return false;
      }
    changes_.replace(old, fresh_);
    return true;
  }

  /// Whether none of its pieces has been divided in turn.
  bool is_last_there(const split_record& split) const {
    return std::all_of(split.children.begin(), split.children.end(),
                       [&](const simplex<2>& t) { return kept_.has(t[0], t[1], t[2]); });
  }
  bool undo(std::size_t k) {
    const split_record& split = splits_[k];
    if (!refill(split))
      return false;
    for (const auto& triangle : split.children)
      kept_.set_triangle(triangle, false);
    for (const auto& edge : split.edges)
      kept_.set_edge(edge[0], edge[1], false);
    for (const auto& triangle : split.parents)
      kept_.set_triangle(triangle, true);
    if (split.parent_edge[0] != no_id)
      kept_.set_edge(split.parent_edge[0], split.parent_edge[1], true);
    splits_.erase(splits_.begin() + static_cast<std::ptrdiff_t>(k));
    return true;
  }

  local_changes& changes_;
  kept_entities& kept_;
  region_growth growth_;
  bool is_thorough_ = false;
  std::vector<split_record> splits_;
  std::vector<place> places_;
  std::vector<local_id> star_;
  std::vector<simplex<3>> fresh_;
};

} // namespace dovetail::detail
