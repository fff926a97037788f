/// @file
/// Removal of an edge: the best triangulation of the ring around it, by dynamic programming.
///
/// A ring of three is the 3-2 flip, of four the 4-4 flip. The recurrence over sub-polygons is G. T.
/// Klincsek's, used for edge removal by Shewchuk ("Two discrete optimization algorithms for the topological
/// improvement of tetrahedral meshes"). O(n^3) triangles in the worst case; triangles that cannot help are
/// not evaluated.
#pragma once

#include "dovetail/improver/shape_measure.hpp"
#include "dovetail/improver/tetrahedra/local_change.hpp"
#include "dovetail/improver/tetrahedra/tet_walks.hpp"

namespace dovetail::improvement {

using edge_ends = std::array<local_id, 2>; ///< the two vertices of an edge

/// Finds the best way to remove an edge. Holds the tables, so that nothing is allocated per call.
template <shape_measure Measure>
class edge_removal {
public:
  static constexpr const char* name = "edge removal"; ///< for reports

  /// For best_change: each edge of `e`.
  template <class Offer>
  void propose(const tet_complex& mesh, local_id e, const Offer& offer) {
    for (int edge = 0; edge < 6 && offer.is_open(); ++edge)
      if (collect_shell(mesh, e, edge, shell_))
        offer([&](local_change& change) {
          return find(mesh, shell_, worst_value(mesh, shell_.elements.view()), change);
        });
  }

  /// The best removal of the edge of `shell` if all its elements are better than `bar`, else false. Elements
  /// with an edge of `passing` need not be better, only positive: they will be replaced in their turn.
  bool find(const tet_complex& mesh, const edge_shell& shell, float bar, local_change& change,
            std::span<const edge_ends> passing = {}) {
    const int n = shell.ring.size;
    if (n < 3)
      return false;
    a_ = mesh.point(shell.a);
    b_ = mesh.point(shell.b);
    for (int i = 0; i < n; ++i)
      ring_[i] = mesh.point(shell.ring[i]);
    if (!(triangulate(shell, bar, passing) > bar))
      return false;
    change.clear();
    for (const local_id e : shell.elements)
      change.old.push(e);
    emit(shell, 0, n - 1, change);
    return true;
  }

private:
  struct cell {
    float worst;        ///< of the best triangulation of the sub-polygon i..j
    float above, below; ///< of the two elements on its triangle (i, apex, j)
    int apex;
  };
  static bool has_edge_of(const simplex<3>& element, std::span<const edge_ends> edges) {
    const auto has = [&](local_id v) {
      return std::find(element.begin(), element.end(), v) != element.end();
    };
    return std::any_of(edges.begin(), edges.end(),
                       [&](const edge_ends& edge) { return has(edge[0]) && has(edge[1]); });
  }
  cell& at(int i, int j) { return cells_[i * max_shell + j]; }

  /// Fills the table; the result is the worst value of the best triangulation, or -2 when none beats `bar`.
  float triangulate(const edge_shell& shell, float bar, std::span<const edge_ends> passing) {
    const int n = shell.ring.size;
    const auto counted = [&](float value, local_id end, int i, int j, int k) {
      const bool passes =
          !passing.empty() && has_edge_of({end, shell.ring[i], shell.ring[j], shell.ring[k]}, passing);
      return !passes ? value : value > 0 ? 2.0F : -2.0F;
    };
    for (int i = 0; i + 1 < n; ++i)
      at(i, i + 1).worst = 2;
    for (int span = 2; span < n; ++span)
      for (int i = 0; i + span < n; ++i) {
        const int j = i + span;
        cell best{-2, 0, 0, no_id};
        for (int k = i + 1; k < j; ++k) {
          const float parts = std::min(at(i, k).worst, at(k, j).worst);
          const float needed = std::max(bar, best.worst);
          if (!(parts > needed))
            continue;
          const auto above = static_cast<float>(measure_of<Measure>(b_, ring_[i], ring_[j], ring_[k]));
          const float counted_above = counted(above, shell.b, i, j, k);
          if (!(counted_above > needed))
            continue;
          const auto below = static_cast<float>(measure_of<Measure>(a_, ring_[i], ring_[k], ring_[j]));
          const float counted_below = counted(below, shell.a, i, j, k);
          if (counted_below > needed)
            best = {std::min({parts, counted_above, counted_below}), above, below, k};
        }
        at(i, j) = best;
      }
    return at(0, n - 1).worst;
  }
  void emit(const edge_shell& shell, int i, int j, local_change& change) {
    if (j - i < 2)
      return;
    const cell& c = at(i, j);
    const local_id vi = shell.ring[i], vk = shell.ring[c.apex], vj = shell.ring[j];
    change.add({shell.b, vi, vj, vk}, c.above);
    change.add({shell.a, vi, vk, vj}, c.below);
    emit(shell, i, c.apex, change);
    emit(shell, c.apex, j, change);
  }

  edge_shell shell_;
  std::array<cell, static_cast<std::size_t>(max_shell* max_shell)> cells_;
  std::array<vec3, static_cast<std::size_t>(max_shell)> ring_;
  vec3 a_, b_;
};

} // namespace dovetail::improvement
