/// @file
/// Where the boundaries of parts are not manifold.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace dovetail {

/// The elements around each point, growing.
template <int D>
compressed_rows<local_id> elements_around_points(const simplicial_mesh<D>& mesh) {
  return sorted_into_rows<local_id>(mesh.points.size(), [&](const auto& put) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (const local_id v : mesh.elements[e])
        put(v, static_cast<local_id>(e));
  });
}

/// How far a boundary is from a manifold.
struct defect_count {
  int edges = 0;  ///< D = 3: pairs of sides too many at an edge, counted at each of its two ends
  int points = 0; ///< fans of sides too many at a point

  bool any() const { return edges != 0 || points != 0; }
  friend bool operator==(const defect_count&, const defect_count&) = default;
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
      : mesh_(mesh), sides_(sides), around_(elements_around_points(mesh)),
        on_boundary_(mesh.points.size(), 0) {
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (!sides.is_interior(static_cast<local_id>(s)))
        for (const local_id v : sides.vertices[s])
          on_boundary_[static_cast<std::size_t>(v)] = 1;
  }

  const compressed_rows<local_id>& around() const { return around_; }
  /// Is there a side at the point that bounds some part, whatever the parts are?
  bool is_on_boundary(local_id point) const { return on_boundary_[static_cast<std::size_t>(point)] != 0; }

  /// Defects at a point, all parts together; `part_of(element)` is the part of an element.
  template <class PartOf>
  defect_count count_at(local_id point, const PartOf& part_of) {
    defect_count defects;
    if (is_inside_one_part(point, part_of))
      return defects;
    collect_boundary(point, part_of);
    for (std::size_t first = 0; first < sides_here_.size();) {
      std::size_t last = first;
      while (last < sides_here_.size() && sides_here_[last].part == sides_here_[first].part)
        ++last;
      defects += count_in_link(std::span(sides_here_).subspan(first, last - first));
      first = last;
    }
    return defects;
  }

private:
  /// A boundary side of a part at the point: an edge of the link (D = 3), with its ends, or a point (D = 2).
  struct link_side {
    local_id part;
    local_id a;
    local_id b;

    auto key() const { return std::tuple(part, a, b); }
  };

  template <class PartOf>
  bool is_inside_one_part(local_id point, const PartOf& part_of) const {
    const auto elements = around_[point];
    return !is_on_boundary(point) && std::all_of(elements.begin(), elements.end(), [&](local_id e) {
      return part_of(e) == part_of(elements.front());
    });
  }

  template <class PartOf>
  void collect_boundary(local_id point, const PartOf& part_of) {
    sides_here_.clear();
    for (const local_id e : around_[point]) {
      const auto& vertices = mesh_.elements[static_cast<std::size_t>(e)];
      const local_id own = part_of(e);
      for (std::size_t i = 0; i <= static_cast<std::size_t>(D); ++i) {
        if (vertices[i] == point)
          continue; // the side opposite the point
        const local_id other = sides_.across(sides_.of_element[static_cast<std::size_t>(e)][i], e);
        if (other != no_id && part_of(other) == own)
          continue;
        link_side side{own, no_id, no_id};
        for (const int local : numbering::sides<D>[i])
          if (const local_id v = vertices[static_cast<std::size_t>(local)]; v != point)
            (side.a == no_id ? side.a : side.b) = v;
        sides_here_.push_back(side);
      }
    }
    sort_all(sides_here_, [](const link_side& x, const link_side& y) { return x.key() < y.key(); });
  }

  defect_count count_in_link(std::span<const link_side> link) {
    if constexpr (D == 2)
      return {0, std::max(0, (static_cast<int>(link.size()) + 1) / 2 - 1)};
    ends_.clear();
    for (const link_side& side : link) {
      ends_.push_back(side.a);
      ends_.push_back(side.b);
    }
    sort_all(ends_);
    defect_count defects;
    for (std::size_t first = 0; first < ends_.size();) {
      std::size_t last = first;
      while (last < ends_.size() && ends_[last] == ends_[first])
        ++last;
      defects.edges += std::max(0, (static_cast<int>(last - first) + 1) / 2 - 1);
      first = last;
    }
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    defects.points = components(link) - 1;
    return defects;
  }

  /// Connected components of the graph whose edges are the link's sides and whose nodes are `ends_`.
  int components(std::span<const link_side> link) {
    parents_.resize(ends_.size());
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    const auto root = [&](local_id v) {
      auto k = static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), v) - ends_.begin());
      while (parents_[k] != k)
        k = parents_[k] = parents_[parents_[k]];
      return k;
    };
    auto count = static_cast<int>(ends_.size());
    for (const link_side& side : link) {
      const std::size_t a = root(side.a);
      const std::size_t b = root(side.b);
      if (a != b) {
        parents_[a] = b;
        --count;
      }
    }
    return count;
  }

  const simplicial_mesh<D>& mesh_;
  const side_table<D>& sides_;
  compressed_rows<local_id> around_;
  std::vector<std::uint8_t> on_boundary_; ///< per point
  std::vector<link_side> sides_here_;     ///< scratch
  std::vector<local_id> ends_;            ///< scratch
  std::vector<std::size_t> parents_;      ///< scratch
};

} // namespace dovetail
