/// @file
/// What `patch_remesher.hpp` declares.
#pragma once

#include "dovetail/core/hash.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesh/element_angles.hpp"
#include "dovetail/mesh/surface_smoothing.hpp"
#include "dovetail/remesh/frontal_fill.hpp"
#include "dovetail/remesh/initial_patch.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/remesh/repeated_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace dovetail::detail {

/// One call of the remesher: its steps, with its parameters.
struct patch_filling : remesh::patch_remesher {
  template <patch_surface Surface>
  patch_mesh mesh_patch(const Surface& surface, const patch_boundary& boundary,
                        const any_sizing& sizing) const {
    const stopwatch clock;
    patch_mesh mesh;
    mesh.summary.name = "patch";
    patch_state<Surface> state(surface, sizing);
    if (start_patch(state, boundary, mesh)) {
      flip_queue flips;
      fill(state, flips);
      separate_repeated_edges(state, boundary, flips, mesh);
      export_mesh(state, mesh);
    }
    mesh.summary.seconds = clock.seconds();
    return mesh;
  }

private:
  template <class State>
  void fill(State& state, flip_queue& flips) const {
    resolve_curvature(state);
    flip_all(state, flips);
    unfold(state, flips);
    flips.push_all(state);
    flips.make_delaunay(state);
    fill_from_boundary(state, flips);
    smoother smooth(state);
    const std::size_t most_points = 2 * state.point.size() + 1000;
    for (int cycle = 0; cycle < cycles; ++cycle) {
      const std::size_t changes =
          collapse_short_edges(state, flips) + split_long_edges(state, flips, long_edge, most_points);
      flip_all(state, flips);
      if (cycle > 0 && changes > 0)
        smooth.wake_all();
      for (int pass = 0; pass < smoothing_passes; ++pass)
        if (smooth.pass() == 0)
          break;
    }
    flip_all(state, flips);
    hopeless_stars hopeless;
    for (int round = 0; round < repair_rounds; ++round)
      if (repair_worst(state, flips, smooth, hopeless) == 0)
        break;
  }

  /// Whether the boundary turns by 40 degrees within a size, as that of a tube thinner than it: more points
  /// would make no better triangles.
  template <class State>
  static bool turns_within_sizes(const State& state) {
    constexpr double cosine = 0.77;
    for (local_id c = 0; c < static_cast<local_id>(state.table.vertex.size()); ++c) {
      if (!state.table.alive(c / 3) || state.table.free_side(c))
        continue;
      const local_id a = state.table.tail(c), b = state.table.head(c);
      if (dot(state.normal[a], state.normal[b]) < cosine)
        return true;
    }
    return false;
  }

  /// Where the surface turns much within the last triangles before the front, as on the inside of a pipe, new
  /// points would fold them, and it stops there: their edges are split, and it goes on.
  template <class State>
  void fill_from_boundary(State& state, flip_queue& flips) const {
    constexpr int most_sweeps = 8;
    constexpr double far_too_long = 4; // what the splits of the cycles below cannot mend
    front_parameters how;
    how.growth = size_growth;
    front(state, how).run(flips);
    if (turns_within_sizes(state))
      return;
    const std::size_t most_points = 20 * state.point.size() + 20000; // as where edges bridge curvature
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      if (split_long_edges(state, flips, far_too_long, most_points) == 0)
        return;
      flips.push_all(state);
      flips.make_delaunay(state);
      front(state, how).run(flips);
    }
  }

  template <class State>
  static void flip_all(State& state, flip_queue& flips) {
    flips.push_all(state);
    flips.raise_quality(state);
  }

  template <class State>
  std::size_t collapse_short_edges(State& state, flip_queue& flips) const {
    std::size_t removed = 0;
    for (local_id v = state.frozen; v < static_cast<local_id>(state.point.size()); ++v) {
      if (state.table.corner_of[v] == no_id)
        continue;
      double shortest = std::numeric_limits<double>::infinity();
      int valence = 0;
      state.table.for_each_corner(v, [&](local_id c) {
        shortest = std::min(shortest, state.relative_length(v, state.table.tail(c)));
        ++valence;
      });
      if (shortest >= short_edge && valence > 4)
        continue;
      const double now = star_quality(state, v);
      const double required = shortest < short_edge ? std::min(now - 1e-9, 0.2)
                              : valence == 3        ? std::min(now - 1e-9, 0.1)
                                                    : now;
      if (remove_vertex(state, v, required, long_edge, flips))
        ++removed;
    }
    flips.raise_quality(state);
    return removed;
  }

  /// On a face that turns much within one size, such as a tube that is thinner, this and the collapses can
  /// work against each other; so there is an end to the points.
  /// \param longest times the size
  template <class State>
  static std::size_t split_long_edges(State& state, flip_queue& flips, double longest,
                                      std::size_t most_points) {
    std::size_t added = 0;
    const auto corners = static_cast<local_id>(state.table.vertex.size());
    for (local_id c = 0; c < corners && state.point.size() < most_points; ++c) {
      if (!state.table.alive(c / 3) || !state.table.free_side(c) || state.table.twin[c] < c)
        continue;
      if (state.relative_length(state.table.tail(c), state.table.head(c)) <= longest)
        continue;
      if (const local_id v = split_at_middle(state, c, flips); v != no_id) {
        flips.raise_quality(state);
        ++added;
      }
    }
    return added;
  }

  /// The stars that repair could not make better, by vertex: tried again they would give the same. On a tube
  /// far thinner than the size most triangles stay bad, and each vertex is a corner of six.
  class hopeless_stars {
  public:
    template <class State>
    bool has(const State& state, local_id v) const {
      return static_cast<std::size_t>(v) < keys_.size() && keys_[v] == key_of(state, v);
    }
    template <class State>
    void add(const State& state, local_id v) {
      keys_.resize(state.point.size(), 0);
      keys_[v] = key_of(state, v);
    }

  private:
    /// Points and frames follow from the parameters.
    template <class State>
    static std::uint64_t key_of(const State& state, local_id v) {
      content_hash hash;
      const auto add_vertex = [&](local_id w) {
        hash.word(static_cast<std::uint64_t>(w));
        hash.number(state.xy[w].x);
        hash.number(state.xy[w].y);
      };
      add_vertex(v);
      state.table.for_each_corner(v, [&](local_id c) { add_vertex(state.table.tail(c)); });
      return hash.value();
    }

    std::vector<std::uint64_t> keys_;
  };

  /// Works on each triangle below 30 degrees by flips, moves, removal of a vertex and, at last, a split.
  template <class State>
  std::size_t repair_worst(State& state, flip_queue& flips, smoother<State>& smooth,
                           hopeless_stars& hopeless) const {
    constexpr double thirty_degrees = 0.25;
    std::size_t improved = 0;
    const local_id slots = state.table.triangle_slots(); // triangles added on the way wait for the next round
    for (local_id t = 0; t < slots; ++t) {
      if (!state.table.alive(t) || state.quality(t) >= thirty_degrees)
        continue;
      const double before = state.quality(t);
      for (local_id c = 3 * t; c < 3 * t + 3; ++c)
        flips.push(c);
      if (flips.raise_quality(state) > 0)
        ++improved;
      for (local_id i = 0; i < 3 && state.table.alive(t) && state.quality(t) < thirty_degrees; ++i) {
        const local_id v = state.table.vertex[3 * t + i];
        if (!state.inner(v) || hopeless.has(state, v))
          continue;
        const double worst = star_quality(state, v);
        if (remove_vertex(state, v, std::max(worst + 0.01, 0.0), long_edge, flips)) {
          flips.raise_quality(state);
          ++improved;
          break;
        }
        if (smooth.maximise_worst(v))
          ++improved;
        else
          hopeless.add(state, v);
      }
      if (state.table.alive(t) && state.quality(t) < 0 && before < 0)
        improved += split_folded(state, t, flips);
    }
    return improved;
  }

  /// Splits the free side of a folded triangle that is longest in the scaled parameter plane (in space it may
  /// be a short chord of a long way around): smaller triangles follow the surface better.
  template <class State>
  static std::size_t split_folded(State& state, local_id t, flip_queue& flips) {
    local_id longest = no_id;
    double length = 0;
    for (local_id c = 3 * t; c < 3 * t + 3; ++c)
      if (const double l = norm(state.xy[state.table.head(c)] - state.xy[state.table.tail(c)]);
          state.table.free_side(c) && l > length) {
        longest = c;
        length = l;
      }
    if (longest == no_id || split_at_middle(state, longest, flips) == no_id)
      return 0;
    flips.raise_quality(state);
    return 1;
  }

  /// Numbers inner vertices without gaps and measures the result.
  template <class State>
  static void export_mesh(const State& state, patch_mesh& mesh) {
    std::vector<local_id> number(state.point.size(), no_id);
    for (local_id v = 0; v < state.frozen; ++v)
      number[v] = v;
    for (local_id v = state.frozen; v < static_cast<local_id>(state.point.size()); ++v) {
      if (state.table.corner_of[v] == no_id)
        continue;
      number[v] = state.frozen + static_cast<local_id>(mesh.inner_uv.size());
      mesh.inner_uv.push_back({state.xy[v].x / state.scale.x, state.xy[v].y / state.scale.y});
      mesh.inner_points.push_back(state.point[v]);
    }
    double angle_sum = 0, least = 0.75, length_sum = 0;
    std::size_t below_thirty = 0, lengths = 0;
    for (local_id t = 0; t < state.table.triangle_slots(); ++t) {
      if (!state.table.alive(t))
        continue;
      simplex<2> triangle;
      for (local_id i = 0; i < 3; ++i)
        triangle[i] = state.table.vertex[3 * t + i];
      if (state.vanishes(triangle[0], triangle[1], triangle[2]))
        continue;
      const double q = state.quality(t);
      if (q <= 0 && !state.within_misfit(t))
        mesh.folded.push_back(static_cast<local_id>(mesh.triangles.size()));
      least = std::min(least, q);
      below_thirty += q < 0.25 - 1e-12;
      angle_sum += q > 0 ? std::asin(std::sqrt(q)) : 0;
      for (local_id c = 3 * t; c < 3 * t + 3; ++c)
        if (state.table.twin[c] > c) {
          length_sum += state.relative_length(state.table.tail(c), state.table.head(c));
          ++lengths;
        }
      for (local_id& v : triangle)
        v = number[v];
      mesh.triangles.push_back(triangle);
    }
    const double count = static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
    mesh.summary.set(
        remeshed_counts{.triangles = mesh.triangles.size(),
                        .min_angle_deg = least > 0 ? degrees_per_radian * std::asin(std::sqrt(least)) : 0,
                        .mean_min_angle_deg = degrees_per_radian * angle_sum / count,
                        .below_30_deg = below_thirty,
                        .mean_relative_length =
                            lengths > 0 ? State::calibration * length_sum / static_cast<double>(lengths) : 1,
                        .folded = mesh.folded.size()});
  }
};

} // namespace dovetail::detail

namespace dovetail::remesh {

DOVETAIL_INLINE patch_mesh patch_remesher::operator()(const any_surface& surface,
                                                      const patch_boundary& boundary,
                                                      const any_sizing& sizing) const {
  const dovetail::detail::patch_filling filling{*this};
  return surface.plane ? filling.mesh_patch(*surface.plane, boundary, sizing)
                       : filling.mesh_patch(surface, boundary, sizing);
}

} // namespace dovetail::remesh
