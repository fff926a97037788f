/// @file
/// Shell transformation: an edge that cannot be removed as it is, because its ring has no good triangulation,
/// is removed after its shell has been shrunk by removing edges next to it, recursively.
///
/// After J. Chen, J. Zheng, Y. Zheng, H. Xiao, H. Si, Y. Yao, "Tetrahedral mesh improvement by shell
/// transformation", doi 10.1007/s00366-016-0480-z. Here the steps are carried out on the mesh and taken back
/// when they lead nowhere.
#pragma once

#include "dovetail/improver/tetrahedra/edge_removal.hpp"
#include "dovetail/improver/tetrahedra/operation_limits.hpp"

namespace dovetail::improvement {

/// The operation that shrinks the shell of an edge, then removes it.
template <shape_measure Measure>
class shell_transformation {
public:
  static constexpr std::array names{"shell transformation"}; ///< for reports
  static constexpr turn when = turn::hard; ///< it is tried in the sweeps with hard operations

  /// Tries each edge of `e` until one can be removed.
  bool mend(tet_complex& mesh, local_id e, const operation_limits<3>& limits, const recorded_tries& tries) {
    for (int edge = 0; edge < 6; ++edge)
      if (tries([&] { return improve(mesh, e, edge, limits.band); }))
        return true;
    return false;
  }

  /// Edge removals tried for one edge, at most, and how far they may lead away from it.
  static constexpr int max_tries = 24, max_depth = 2;

  /// Removes edge `edge` of `e` when all elements that take the place of others are better than the worst
  /// one at the edge; else the mesh is left as it was. O(max_tries) edge
  /// removals.
  bool improve(tet_complex& mesh, local_id e, int edge, const size_band& band) {
    edge_shell shell;
    if (mesh.is_tangled() || !collect_shell(mesh, e, edge, shell))
      return false;
    bar_ = worst_value(mesh, shell.elements.view());
    tries_ = max_tries;
    steps_ = 0;
    doomed_.size = 0;
    return remove(mesh, shell, band, max_depth);
  }

private:
  /// What is needed to take one removal back.
  struct step {
    bounded_list<local_id, 2 * max_shell> fresh;
    bounded_list<simplex<3>, max_shell> old;
    bounded_list<float, max_shell> values;
    bounded_list<local_id, max_shell + 2> vertices;
    bounded_list<std::uint32_t, max_shell + 2> changed_at;

    void clear() { fresh.size = old.size = values.size = vertices.size = changed_at.size = 0; }
  };

  /// False leaves the mesh as it was.
  bool remove(tet_complex& mesh, const edge_shell& shell, const size_band& band, int depth) {
    if (tries_ == 0)
      return false;
    --tries_;
    if (removal_.find(mesh, shell, bar_, change_, doomed_.view()) && is_sound(mesh, change_) &&
        band.admits(mesh, change_)) {
      take(mesh, shell);
      return true;
    }
    return depth > 0 && shell.ring.size > 3 && remove_shrunk(mesh, shell, band, depth);
  }

  /// Removes an edge between an end of the shell's edge and a vertex of its ring, then the shell's own edge.
  bool remove_shrunk(tet_complex& mesh, const edge_shell& shell, const size_band& band, int depth) {
    if (!doomed_.push({shell.a, shell.b}))
      return false;
    const int first_step = steps_;
    for (int i = 0; i < shell.ring.size; ++i)
      for (const local_id end : {shell.a, shell.b}) {
        edge_shell neighbour, shrunk;
        const local_id e = shell.elements[i]; // undone steps leave its number as it was
        if (!collect_shell(mesh, e, edge_of(mesh, e, end, shell.ring[i]), neighbour) ||
            !remove(mesh, neighbour, band, depth - 1))
          continue;
        if (collect_again(mesh, shell, shrunk) && shrunk.ring.size < shell.ring.size) {
          --doomed_.size;
          if (remove(mesh, shrunk, band, depth))
            return true;
          ++doomed_.size; // the same edge is still in its place
        }
        take_back(mesh, first_step);
      }
    --doomed_.size;
    return false;
  }

  static int edge_of(const tet_complex& mesh, local_id e, local_id p, local_id q) {
    for (int edge = 0; edge < 6; ++edge) {
      const auto& corners = edge_corners[edge];
      const local_id a = mesh.vertex(e, corners[0]), b = mesh.vertex(e, corners[1]);
      if ((a == p && b == q) || (a == q && b == p))
        return edge;
    }
    return -1;
  }
  static bool has(const tet_complex& mesh, local_id e, local_id v) {
    return mesh.vertex(e, mesh.corner_of(e, v)) == v;
  }
  /// The shell as the last removal left it.
  bool collect_again(const tet_complex& mesh, const edge_shell& shell, edge_shell& again) const {
    for (const local_id e : taken_[steps_ - 1].fresh)
      if (has(mesh, e, shell.a) && has(mesh, e, shell.b))
        return collect_shell(mesh, e, edge_of(mesh, e, shell.a, shell.b), again);
    return false;
  }

  /// Carries `change_` out and notes how to take it back.
  void take(tet_complex& mesh, const edge_shell& shell) {
    step& taken = taken_[steps_++];
    taken.clear();
    for (const local_id e : change_.old) {
      taken.old.push(mesh.vertices(e));
      taken.values.push(mesh.value(e));
    }
    const auto note = [&](local_id v) {
      taken.vertices.push(v);
      taken.changed_at.push(mesh.changed_at(v));
    };
    note(shell.a);
    note(shell.b);
    for (const local_id v : shell.ring)
      note(v);
    taken.fresh.size = change_.fresh.size;
    mesh.replace(change_.old.view(), change_.fresh.view(), change_.values.view(),
                 {taken.fresh.items.data(), static_cast<std::size_t>(taken.fresh.size)});
  }
  void take_back(tet_complex& mesh, int until) {
    while (steps_ > until) {
      const step& taken = taken_[--steps_];
      std::array<local_id, static_cast<std::size_t>(max_shell)> ids;
      mesh.replace(taken.fresh.view(), taken.old.view(), taken.values.view(),
                   {ids.data(), static_cast<std::size_t>(taken.old.size)});
      for (int i = 0; i < taken.vertices.size; ++i)
        mesh.set_changed_at(taken.vertices[i], taken.changed_at[i]);
    }
  }

  edge_removal<Measure> removal_;
  local_change change_;
  bounded_list<edge_ends, max_tries> doomed_; ///< edges that will be removed after the present one
  std::array<step, static_cast<std::size_t>(max_tries)> taken_;
  float bar_ = 0;
  int tries_ = 0, steps_ = 0;
};

} // namespace dovetail::improvement
