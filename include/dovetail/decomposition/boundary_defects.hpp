/// @file
/// Where the boundaries of parts are not manifold.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/mesh/adjacency.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail {

/// The elements around each point of a mesh, and the points where it ends: what no partition changes.
template <int D>
struct point_stars {
  compressed_rows<local_id> elements;    ///< around each point, growing
  std::vector<std::uint8_t> on_boundary; ///< per point: whether a side there has one element

  point_stars(const simplicial_mesh<D>& mesh, const side_table<D>& sides)
      : elements(sorted_into_rows<local_id>(mesh.points.size(),
                                            [&](const auto& put) {
                                              for (std::size_t e = 0; e < mesh.elements.size(); ++e)
                                                for (const local_id v : mesh.elements[e])
                                                  put(v, static_cast<local_id>(e));
                                            })),
        on_boundary(mesh.points.size(), 0) {
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (!sides.is_interior(static_cast<local_id>(s)))
        for (const local_id v : sides.vertices[s])
          on_boundary[v] = 1;
  }
};

/// How far a boundary is from a manifold.
struct defect_count {
  int edges = 0;  ///< D = 3: pairs of sides too many at an edge, counted at each of its two ends
  int points = 0; ///< fans of sides too many at a point

  bool any() const { return edges != 0 || points != 0; } ///< whether there are any defects
  friend bool operator==(const defect_count&, const defect_count&) = default;
  /// Adds the counts of another.
  defect_count& operator+=(const defect_count& other) {
    edges += other.edges;
    points += other.points;
    return *this;
  }
  friend defect_count operator-(const defect_count& a, const defect_count& b) {
    return {a.edges - b.edges, a.points - b.points};
  }
};

/// Counts how far the boundaries of the parts are from manifolds at single points.
///
/// At a manifold point the boundary of a part is one fan of sides: for D = 3 one cycle of triangles with two
/// at each edge, for D = 2 two edges.
template <int D>
class boundary_defects {
public:
  boundary_defects(const simplicial_mesh<D>& mesh, const side_table<D>& sides)
      : boundary_defects(mesh, sides, std::make_shared<const point_stars<D>>(mesh, sides)) {}
  /// With the stars of this mesh, where there are some already.
  boundary_defects(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                   std::shared_ptr<const point_stars<D>> stars)
      : mesh_(mesh), sides_(sides), stars_(std::move(stars)), place_in_link_(mesh.points.size()) {}

  /// The elements around each point.
  const compressed_rows<local_id>& around() const { return stars_->elements; }
  /// Is there a side at the point that bounds some part, whatever the parts are?
  bool is_on_boundary(local_id point) const { return stars_->on_boundary[point] != 0; }

  /// Defects at a point, all parts together; `part_of(element)` is the part of an element.
  template <class PartOf>
  defect_count count_at(local_id point, const PartOf& part_of) {
    defect_count defects;
    if (is_inside_one_part(point, part_of))
      return defects;
    collect_boundary(point, part_of);
    while (!sides_here_.empty())
      defects += count_in_link(sides_here_.back().part);
    return defects;
  }

private:
  /// A boundary side of a part at the point: an edge of the link (D = 3), with its ends, or a point (D = 2).
  struct link_side {
    local_id part;
    local_id a;
    local_id b;
  };
  /// A point of the link at hand.
  struct link_end {
    int sides = 0;
    std::size_t parent = 0; ///< in the forest of those that sides connect
  };

  template <class PartOf>
  bool is_inside_one_part(local_id point, const PartOf& part_of) const {
    const auto elements = around()[point];
    return !is_on_boundary(point) && std::all_of(elements.begin(), elements.end(), [&](local_id e) {
      return part_of(e) == part_of(elements.front());
    });
  }

  template <class PartOf>
  void collect_boundary(local_id point, const PartOf& part_of) {
    sides_here_.clear();
    for (const local_id e : around()[point]) {
      const auto& vertices = mesh_.elements[e];
      const local_id own = part_of(e);
      for (std::size_t i = 0; i <= static_cast<std::size_t>(D); ++i) {
        if (vertices[i] == point)
          continue; // the side opposite the point
        const local_id other = sides_.across(sides_.of_element[e][i], e);
        if (other != no_id && part_of(other) == own)
          continue;
        link_side side{own, no_id, no_id};
        for (const int local : numbering::sides<D>[i])
          if (const local_id v = vertices[local]; v != point)
            (side.a == no_id ? side.a : side.b) = v;
        sides_here_.push_back(side);
      }
    }
  }

  /// Takes the link of one part out of `sides_here_`.
  defect_count count_in_link(local_id part) {
    ends_.clear();
    ++link_;
    int sides = 0;
    int components = 0;
    std::size_t left = 0;
    for (const link_side& side : sides_here_) {
      if (side.part != part) {
        sides_here_[left++] = side;
        continue;
      }
      ++sides;
      if constexpr (D == 3) {
        const std::size_t a = end_of_side(side.a, components);
        const std::size_t b = end_of_side(side.b, components);
        if (a != b) {
          ends_[a].parent = b;
          --components;
        }
      }
    }
    sides_here_.resize(left);
    if constexpr (D == 2)
      return {0, std::max(0, (sides + 1) / 2 - 1)};
    defect_count defects{0, components - 1};
    for (const link_end& end : ends_)
      defects.edges += std::max(0, (end.sides + 1) / 2 - 1);
    return defects;
  }

  /// Counts one more side at a point of the link; returns the root of what it is connected with.
  std::size_t end_of_side(local_id point, int& components) {
    auto& [link, place] = place_in_link_[point];
    if (link != link_) {
      link = link_;
      place = static_cast<std::uint32_t>(ends_.size());
      ends_.push_back({0, ends_.size()});
      ++components;
    }
    ++ends_[place].sides;
    std::size_t k = place;
    while (ends_[k].parent != k)
      k = ends_[k].parent = ends_[ends_[k].parent].parent;
    return k;
  }

  const simplicial_mesh<D>& mesh_;
  const side_table<D>& sides_;
  std::shared_ptr<const point_stars<D>> stars_;
  // Scratch:
  std::vector<link_side> sides_here_;
  std::vector<link_end> ends_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> place_in_link_; ///< per point: the last link it was in
  std::uint64_t link_ = 0;
};

} // namespace dovetail
