/// @file
/// The edges and triangles that recovery makes part of a tetrahedrization and that no change may take away.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/boundary_sides.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace dovetail::detail {

/// The vertices of an edge, the lower one first.
using vertex_pair = std::array<local_id, 2>;

inline vertex_pair sorted_pair(local_id u, local_id v) {
  return {std::min(u, v), std::max(u, v)};
}

/// Those of a boundary, less some of them and with others that take their place for a while.
class kept_entities {
public:
  /// `sides` must outlive this.
  explicit kept_entities(boundary_sides&&) = delete;
  explicit kept_entities(const boundary_sides& sides) : sides_(sides) {
    std::vector<char> known(sides_.entries().size(), 0);
    for (const auto& triangle : sides.triangles())
      if (char& is_known = known[sides_.find(triangle).entry]; is_known == 0) {
        is_known = 1; // one listed in both directions is one
        triangles_.push_back(triangle);
      }
    triangles_at_ = sorted_into_rows<local_id>(sides.vertex_count(), [&](const auto& put) {
      for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (const local_id v : triangles_[t])
          put(static_cast<std::size_t>(v), static_cast<local_id>(t));
    });
  }

  /// Whether a vertex is no higher than those of the boundary, which come first.
  bool is_of_boundary(local_id v) const { return sides_.may_have(v); }

  /// Linear in the triangles at one of the ends, that with fewer.
  bool has(local_id u, local_id v) const {
    const vertex_pair edge = sorted_pair(u, v);
    if (!changed_edges_.empty())
      if (const auto changed = changed_edges_.find(edge); changed != changed_edges_.end())
        return changed->second;
    if (!is_of_boundary(edge[0]) || !is_of_boundary(edge[1]))
      return false;
    const auto at_one = triangles_at_[edge[0]], at_other = triangles_at_[edge[1]];
    const auto fewer = at_one.size() < at_other.size() ? at_one : at_other;
    return std::any_of(fewer.begin(), fewer.end(),
                       [&](local_id t) { return has_edge(triangles_[t], edge[0], edge[1]); });
  }
  bool has(local_id u, local_id v, local_id w) const {
    if (!changed_triangles_.empty())
      if (const auto changed = changed_triangles_.find(sorted_vertices(simplex<2>{u, v, w}));
          changed != changed_triangles_.end())
        return changed->second.kept;
    return bool(sides_.find({u, v, w}));
  }

  void set_edge(local_id u, local_id v, bool kept) { changed_edges_[sorted_pair(u, v)] = kept; }
  void set_triangle(const simplex<2>& t, bool kept) {
    const auto key = sorted_vertices(t);
    changed_triangles_[key] = {t, kept};
    if (kept)
      for (const auto& local : numbering::sides<2>)
        changed_at_[sorted_pair(t[local[0]], t[local[1]])].push_back(key);
  }

  /// Calls `f` with each triangle that is kept and none of the boundary's.
  template <class F>
  void for_each_new_triangle(const F& f) const {
    for (const auto& [key, changed] : changed_triangles_)
      if (changed.kept && !sides_.find(changed.triangle))
        f(changed.triangle);
  }
  /// Those kept at an edge that is kept. Linear in the triangles at one of its ends and those that were ever
  /// kept at it.
  std::vector<simplex<2>> triangles_at(local_id u, local_id v) const {
    std::vector<simplex<2>> result;
    if (const local_id end = std::min(u, v); is_of_boundary(end))
      for (const local_id t : triangles_at_[end])
        if (has_edge(triangles_[t], u, v) && has(triangles_[t][0], triangles_[t][1], triangles_[t][2]))
          result.push_back(triangles_[t]);
    if (const auto found = changed_at_.find(sorted_pair(u, v)); found != changed_at_.end()) {
      auto keys = found->second;
      sort_unique(keys);
      for (const auto& key : keys)
        if (const changed_triangle& changed = changed_triangles_.at(key); changed.kept && !sides_.find(key))
          result.push_back(changed.triangle);
    }
    return result;
  }

private:
  struct changed_triangle {
    simplex<2> triangle;
    bool kept;
  };
  static bool has_edge(const simplex<2>& t, local_id u, local_id v) {
    const auto has_vertex = [&](local_id w) { return t[0] == w || t[1] == w || t[2] == w; };
    return has_vertex(u) && has_vertex(v);
  }

  const boundary_sides& sides_;
  std::vector<simplex<2>> triangles_;
  std::map<vertex_pair, bool> changed_edges_; // whether they are kept now
  std::map<simplex<2>, changed_triangle> changed_triangles_;
  compressed_rows<local_id> triangles_at_;                    // per vertex of the boundary
  std::map<vertex_pair, std::vector<simplex<2>>> changed_at_; // keys of those that were kept at an edge
};

} // namespace dovetail::detail
