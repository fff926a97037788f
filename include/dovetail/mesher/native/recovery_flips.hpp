/// @file
/// The changes that make room for an edge or a triangle: removal of edges and of sides.
#pragma once

#include "dovetail/mesher/native/kept_entities.hpp"
#include "dovetail/mesher/native/recovery_targets.hpp"
#include "dovetail/mesher/native/star_points.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// Changes that are made when what is in the target's way weighs less afterwards, or, where `allowed_excess`
/// says so, not much more.
class recovery_flips {
public:
  recovery_flips(local_changes& changes, const kept_entities& kept)
      : changes_(changes), kept_(kept), centers_(changes) {}

  /// Exchanges side (u, v, w) between two elements for an edge between their other vertices.
  template <class Target>
  bool remove_side(const Target& target, local_id side, int allowed_excess) {
    const auto& mesh = changes_.mesh();
    const local_id other = mesh.across(side);
    const local_id e = triangulation<3>::element_of(side), n = triangulation<3>::element_of(other);
    const std::size_t place = triangulation<3>::place_of(side);
    const local_id x = mesh[e].vertices[place], y = mesh[n].vertices[triangulation<3>::place_of(other)];
    const simplex<2> s = changes_.side_vertices(e, place);
    if (x < 0 || y < 0 || kept_.has(s[0], s[1], s[2]))
      return false;
    fresh_.clear();
    int change = target.weight(changes_, x, y) - target.weight(changes_, s[0], s[1], s[2]);
    for (std::size_t k = 0; k < 3; ++k) { // y is in front of the side, which faces away from x
      fresh_.push_back({x, s[k], s[(k + 1) % 3], y});
      if (!changes_.is_positive(fresh_.back()))
        return false;
      change += target.weight(changes_, x, y, s[k]);
    }
    if (change > allowed_excess)
      return false;
    const std::array old{e, n};
    changes_.replace(old, fresh_);
    return true;
  }

  /// Exchanges the elements around edge (p, q) for those on both sides of a triangulation of its ring, of all
  /// triangulations the one with the least in the target's way. Dynamic programming over the ring as in
  /// J. R. Shewchuk, "Two discrete optimization algorithms for the topological improvement of tetrahedral
  /// meshes" (2002, after G. Klincsek): O(n^3) for n vertices of the ring, at most `most_ring`.
  template <class Target>
  bool remove_edge(const Target& target, local_id p, local_id q, int allowed_excess) {
    if (kept_.has(p, q))
      return false;
    const local_id e = changes_.element_with_edge(p, q);
    if (e == no_id)
      return false;
    changes_.find_ring(e, p, q, most_ring, ring_);
    const auto& r = ring_.vertices;
    if (r.size() < 3 || *std::min_element(r.begin(), r.end()) < 0)
      return false;
    int before = target.weight(changes_, p, q);
    for (const local_id v : r)
      before += target.weight(changes_, p, q, v);
    if (best_weight(target, p, q, r) > before + allowed_excess)
      return false;
    fresh_.clear();
    add_triangles(p, q, r, 0, r.size() - 1);
    changes_.replace(ring_.elements, fresh_);
    return true;
  }

  /// Makes the target the edge between two vertices of the ring around (p, q), with new points in the parts
  /// of the ring on both sides of it if need be.
  bool divide_ring(const edge_target& target, local_id p, local_id q) {
    const local_id e = kept_.has(p, q) ? no_id : changes_.element_with_edge(p, q);
    if (e == no_id)
      return false;
    changes_.find_ring(e, p, q, most_ring, ring_);
    auto& r = ring_.vertices;
    if (r.size() < 4 || *std::min_element(r.begin(), r.end()) < 0)
      return false;
    const auto first = std::find(r.begin(), r.end(), target.ends[0]);
    if (first == r.end())
      return false;
    std::rotate(r.begin(), first, r.end());
    const auto second = std::find(r.begin(), r.end(), target.ends[1]);
    if (second == r.end())
      return false;
    const std::vector<local_id> one(r.begin(), second + 1);
    std::vector<local_id> other(second, r.end());
    other.push_back(r.front());
    fresh_.clear();
    const std::size_t points = changes_.mesh().points.size();
    if (!fill_part(target, p, q, one) || !fill_part(target, p, q, other)) {
      changes_.drop_points(points);
      return false;
    }
    changes_.replace(ring_.elements, fresh_);
    return true;
  }

  /// Removes the edge (p, q), after edges beside it if need be, whose removal makes the ring one that can be
  /// triangulated; `depth` is how far that goes on. O((2 n)^depth) removals are tried for rings of n.
  template <class Target>
  bool remove_edge_after_others(const Target& target, local_id p, local_id q, int allowed_excess, int depth) {
    if (remove_edge(target, p, q, allowed_excess))
      return true;
    const local_id e =
        depth == 0 || kept_.has(p, q) || changes_.is_spent() ? no_id : changes_.element_with_edge(p, q);
    if (e == no_id)
      return false;
    changes_.find_ring(e, p, q, most_ring, ring_);
    const std::vector<local_id> ring = ring_.vertices;
    for (const local_id r : ring)
      for (const local_id end : {p, q})
        if (r >= 0 && remove_edge_after_others(target, end, r, 0, depth - 1) &&
            remove_edge(target, p, q, allowed_excess))
          return true;
    return false;
  }

private:
  static constexpr std::size_t most_ring = 24;
  static constexpr int impossible = 1 << 28;

  /// Fills the tables of `weight_` and `split_` for the polygon; returns the least weight.
  template <class Target>
  int best_weight(const Target& target, local_id p, local_id q, std::span<const local_id> r) {
    const std::size_t n = r.size();
    for (std::size_t i = 0; i + 1 < n; ++i)
      weight_[i][i + 1] = 0;
    for (std::size_t length = 2; length < n; ++length)
      for (std::size_t i = 0; i + length < n; ++i) {
        const std::size_t j = i + length;
        int best = impossible;
        for (std::size_t k = i + 1; k < j; ++k) {
          const int parts = weight_[i][k] + weight_[k][j];
          if (parts >= best || !changes_.is_positive({r[i], r[k], r[j], q}) ||
              !changes_.is_positive({r[i], r[j], r[k], p}))
            continue;
          const int weight = parts + target.weight(changes_, r[i], r[k], r[j]);
          if (weight < best) {
            best = weight;
            split_[i][j] = k;
          }
        }
        const bool is_diagonal = length + 1 < n;
        if (is_diagonal && best < impossible)
          best += target.weight(changes_, r[i], r[j]) + target.weight(changes_, r[i], r[j], p) +
                  target.weight(changes_, r[i], r[j], q);
        weight_[i][j] = best;
      }
    return weight_[0][n - 1];
  }
  /// Adds the elements on both sides of the best triangulation of the polygon between places i and j.
  void add_triangles(local_id p, local_id q, std::span<const local_id> r, std::size_t i, std::size_t j) {
    if (j == i + 1)
      return;
    const std::size_t k = split_[i][j];
    fresh_.push_back({r[i], r[k], r[j], q});
    fresh_.push_back({r[i], r[j], r[k], p});
    add_triangles(p, q, r, i, k);
    add_triangles(p, q, r, k, j);
  }

  /// Fills the part of a ring within a polygon: by triangles, or else by a star. What is filled is undone by
  /// no one when it fails.
  template <class Target>
  bool fill_part(const Target& target, local_id p, local_id q, std::span<const local_id> polygon) {
    if (best_weight(target, p, q, polygon) < impossible) {
      add_triangles(p, q, polygon, 0, polygon.size() - 1);
      return true;
    }
    // An element (p, q, u, v) of the ring becomes (p, s, u, v) and (s, q, u, v): the sides that s sees.
    std::vector<simplex<2>> sides;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const local_id u = polygon[k], v = polygon[(k + 1) % polygon.size()];
      sides.push_back({p, v, u});
      sides.push_back({q, u, v});
    }
    const star_center center = centers_.best(sides);
    if (center.clearance > 0)
      centers_.add_star(center, sides, fresh_);
    return center.clearance > 0;
  }

  local_changes& changes_;
  const kept_entities& kept_;
  star_centers centers_;
  edge_ring ring_;
  std::vector<simplex<3>> fresh_;
  std::array<std::array<int, most_ring>, most_ring> weight_{};
  std::array<std::array<std::size_t, most_ring>, most_ring> split_{};
};

} // namespace dovetail::detail
