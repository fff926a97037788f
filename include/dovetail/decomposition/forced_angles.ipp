/// @file
/// What `forced_angles.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/forced_angles.hpp"
#include "dovetail/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// The CAD around the places of some violations.
class forcing_entities {
public:
  forcing_entities(const interface_angles& angles, std::span<const simplex<2>> triangles, const cad_mesh& cad,
                   const any_sizing& size, const wanted_angles& wanted)
      : triangles_(triangles), cad_(cad), size_(size), wanted_(wanted) {
    mark_places(angles);
    collect_curves();
    collect_edges();
    find_sharp_edges();
  }

  void judge(angle_violation& violation) const {
    std::vector<host> forcing;
    if (violation.is_dihedral()) {
      add_sharp_edges(violation.edge[0], wanted_.dihedral_deg, forcing);
      add_sharp_edges(violation.edge[1], wanted_.dihedral_deg, forcing);
    } else {
      const auto [corner, side] = corner_of(violation);
      add_sharp_edges(corner, wanted_.face_deg, forcing);
      add_curves(corner, forcing);
      add_short_entity(side, forcing);
    }
    if (!forcing.empty())
      violation.cause = violation_cause::forced;
    violation.cad = forcing.empty() ? around(violation) : std::move(forcing);
    sort_unique(violation.cad);
  }

private:
  vec3 point(local_id v) const { return cad_.points[v]; }
  bool is_near(local_id v) const { return near_[v] != 0; }

  /// A CAD triangle at an edge.
  struct edge_of_triangle {
    simplex<1> edge; ///< in growing order
    std::size_t triangle = 0;
  };
  /// A curve's edge at a place.
  struct edge_of_curve {
    simplex<1> edge;
    local_id curve = no_id;
  };
  /// An edge at which two faces meet at a small angle.
  struct sharp_edge {
    simplex<1> edge;
    std::array<host, 3> entities; ///< the curve and the two faces
    double opening = 0;
  };

  void mark_places(const interface_angles& angles) {
    near_.assign(cad_.points.size(), 0);
    for (const angle_violation& v : angles.violations)
      if (v.is_dihedral())
        for (const local_id end : v.edge)
          near_[end] = 1;
      else
        for (const local_id corner : triangles_[v.sides[0]])
          near_[corner] = 1;
  }

  void collect_curves() {
    for (std::size_t e = 0; e < cad_.curve_edges.size(); ++e) {
      const auto& [a, b] = cad_.curve_edges[e];
      const std::size_t curve = cad_.curves[e];
      length_of_curve_.resize(std::max(length_of_curve_.size(), curve + 1), 0);
      length_of_curve_[curve] += distance(point(a), point(b));
      if (is_near(a) || is_near(b))
        curve_edges_.push_back({sorted_vertices(simplex<1>{a, b}), cad_.curves[e]});
    }
    sort_all(curve_edges_, [](const edge_of_curve& a, const edge_of_curve& b) { return a.edge < b.edge; });
    curve_edges_at_ = edges_at_points(curve_edges_);
  }

  /// Numbers of edges by their ends: few, so that nothing is made for each point of a large mesh.
  class edges_at_points {
  public:
    edges_at_points() = default;
    template <class Edge>
    explicit edges_at_points(const std::vector<Edge>& edges) {
      for (std::size_t e = 0; e < edges.size(); ++e)
        for (const local_id end : edges[e].edge)
          by_end_.push_back({end, e});
      sort_all(by_end_);
    }

    /// Pairs of the point and the number of an edge there, growing.
    std::span<const std::pair<local_id, std::size_t>> operator[](local_id point) const {
      const auto [first, last] =
          std::equal_range(by_end_.begin(), by_end_.end(), std::pair(point, std::size_t{0}),
                           [](const auto& a, const auto& b) { return a.first < b.first; });
      return {first, last};
    }

  private:
    std::vector<std::pair<local_id, std::size_t>> by_end_;
  };

  void collect_edges() {
    for (std::size_t t = 0; t < cad_.triangles.size(); ++t)
      if (cad_.faces[t] != no_id)
        for (std::size_t i = 0; i < 3; ++i)
          if (const auto edge = sorted_vertices(pick(cad_.triangles[t], numbering::sides<2>[i]));
              is_near(edge[0]) || is_near(edge[1]))
            edges_.push_back({edge, t});
    sort_all(edges_, [](const edge_of_triangle& a, const edge_of_triangle& b) {
      return std::tie(a.edge, a.triangle) < std::tie(b.edge, b.triangle);
    });
  }

  template <class Item>
  static std::span<const Item> items_at(const std::vector<Item>& items, simplex<1> edge) {
    const auto [first, last] = std::equal_range(items.begin(), items.end(), Item{edge, {}},
                                                [](const Item& a, const Item& b) { return a.edge < b.edge; });
    return {first, last};
  }
  local_id curve_at(const simplex<1>& edge) const {
    const auto found = items_at(curve_edges_, edge);
    return found.empty() ? no_id : found.front().curve;
  }

  void find_sharp_edges() {
    const double largest = std::max(wanted_.face_deg, wanted_.dihedral_deg);
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for (std::size_t j = i + 1; j < edges_.size() && edges_[j].edge == edges_[i].edge; ++j)
        if (const local_id curve = curve_at(edges_[i].edge); curve != no_id)
          if (const double angle = opening(edges_[i], edges_[j]); angle < largest)
            sharp_.push_back({edges_[i].edge,
                              {host{1, curve}, host{2, cad_.faces[edges_[i].triangle]},
                               host{2, cad_.faces[edges_[j].triangle]}},
                              angle});
    sharp_at_ = edges_at_points(sharp_);
  }

  /// The angle between two triangles at their edge; 360 where nothing is between them.
  double opening(const edge_of_triangle& a, const edge_of_triangle& b) const {
    const vec3 origin = point(a.edge[0]), axis = normalized(point(a.edge[1]) - origin);
    const auto leaves = [&](const edge_of_triangle& of) {
      const simplex<2>& t = cad_.triangles[of.triangle];
      const local_id apex = t[0] + t[1] + t[2] - of.edge[0] - of.edge[1];
      const vec3 d = point(apex) - origin;
      return d - dot(d, axis) * axis;
    };
    const auto normal = [&](const edge_of_triangle& of) {
      const auto p = corners(cad_.points, cad_.triangles[of.triangle]);
      return cross(p[1] - p[0], p[2] - p[0]);
    };
    const vec3 to_a = leaves(a), to_b = leaves(b);
    const bool in_front = dot(normal(a), to_b) > 0 && dot(normal(b), to_a) > 0;
    if (in_front && (cad_.beside[a.triangle][1] == no_id || cad_.beside[b.triangle][1] == no_id))
      return 360;
    return degrees_per_radian * angle_between(to_a, to_b);
  }

  void add_sharp_edges(local_id vertex, double wanted_deg, std::vector<host>& forcing) const {
    for (const auto& [end, sharp] : sharp_at_[vertex])
      if (sharp_[sharp].opening < wanted_deg)
        append(forcing, sharp_[sharp].entities);
  }

  /// Two curves with a small angle between them at their common end.
  void add_curves(local_id vertex, std::vector<host>& forcing) const {
    std::vector<edge_of_curve> here;
    for (const auto& [end, e] : curve_edges_at_[vertex])
      here.push_back(curve_edges_[e]);
    const auto direction = [&](const edge_of_curve& e) {
      return point(e.edge[0] == vertex ? e.edge[1] : e.edge[0]) - point(vertex);
    };
    for (std::size_t i = 0; i < here.size(); ++i)
      for (std::size_t j = i + 1; j < here.size(); ++j)
        if (here[i].edge != here[j].edge &&
            degrees_per_radian * angle_between(direction(here[i]), direction(here[j])) < wanted_.face_deg)
          append(forcing, std::array{host{1, here[i].curve}, host{1, here[j].curve}});
  }

  /// The curve that the side is, or the face that it crosses from curve to curve, if that is too short.
  void add_short_entity(const simplex<1>& side, std::vector<host>& forcing) const {
    const vec3 middle = midpoint(point(side[0]), point(side[1]));
    const double least = 2 * std::sin(0.5 * wanted_.face_deg / degrees_per_radian) * size_(middle);
    if (const local_id curve = curve_at(side); curve != no_id) {
      if (length_of_curve_[curve] < least)
        forcing.push_back({1, curve});
      return;
    }
    if (distance(point(side[0]), point(side[1])) < least && !curve_edges_at_[side[0]].empty() &&
        !curve_edges_at_[side[1]].empty())
      for (const edge_of_triangle& e : items_at(edges_, side))
        forcing.push_back({2, cad_.faces[e.triangle]});
  }

  /// The corner with a triangle's smallest angle, and the side opposite to it.
  std::pair<local_id, simplex<1>> corner_of(const angle_violation& violation) const {
    const simplex<2>& t = triangles_[violation.sides[0]];
    const auto angles = dihedral_angles(corners(cad_.points, t));
    const auto least =
        static_cast<std::size_t>(std::min_element(angles.begin(), angles.end()) - angles.begin());
    return {t[least], sorted_vertices(simplex<1>{t[(least + 1) % 3], t[(least + 2) % 3]})};
  }

  /// The faces that the violation touches with an edge.
  std::vector<host> around(const angle_violation& violation) const {
    std::vector<host> faces;
    const auto add = [&](simplex<1> edge) {
      for (const edge_of_triangle& e : items_at(edges_, sorted_vertices(edge)))
        faces.push_back({2, cad_.faces[e.triangle]});
    };
    if (violation.is_dihedral())
      add(violation.edge);
    else
      for (std::size_t i = 0; i < 3; ++i)
        add(pick(triangles_[violation.sides[0]], numbering::sides<2>[i]));
    return faces;
  }

  std::span<const simplex<2>> triangles_;
  const cad_mesh& cad_;
  const any_sizing& size_;
  wanted_angles wanted_;
  std::vector<std::uint8_t> near_;      ///< per point: whether a violation is there
  std::vector<edge_of_triangle> edges_; ///< at places, by growing edge
  std::vector<edge_of_curve> curve_edges_;
  edges_at_points curve_edges_at_;
  std::vector<double> length_of_curve_;
  std::vector<sharp_edge> sharp_;
  edges_at_points sharp_at_;
};

} // namespace detail

DOVETAIL_INLINE void find_forced(interface_angles& angles, std::span<const simplex<2>> triangles,
                                 const cad_mesh& cad, const any_sizing& size, const wanted_angles& wanted) {
  if (angles.violations.empty())
    return;
  const detail::forcing_entities entities(angles, triangles, cad, size, wanted);
  for (angle_violation& violation : angles.violations)
    entities.judge(violation);
}

} // namespace dovetail
