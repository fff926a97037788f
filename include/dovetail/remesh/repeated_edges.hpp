/// @file
/// Keeps a patch a manifold in 3-space: two inner edges never join the same two vertices.
///
/// Inner edges whose ends both lie on the boundary ("chords") coincide with each other across a seam, with a
/// boundary segment, or with a chord of another patch. The rare ones with one end inside, across a seam, are
/// left to `unwanted_chord_splitter`.
#pragma once

#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/surface_smoothing.hpp"
#include "dovetail/remesh/patch_state.hpp"

#include <map>

namespace dovetail::detail {

using label_pair = simplex<1>;

/// Counts, per pair of labels, the different edges of 3-space that join them, and returns the chords that
/// must be split to leave at most one. A triangle on a pole has two sides that are one edge of 3-space.
template <class S>
std::vector<local_id> repeated_chords(const patch_state<S>& s, const patch_boundary& boundary) {
  std::map<label_pair, int> edges;
  for (const auto& [a, b] : boundary.segments)
    edges[sorted_vertices(label_pair{s.label[a], s.label[b]})] = 1;
  for (const label_pair& pair : boundary.forbidden_edges)
    edges[sorted_vertices(label_pair{pair[0], pair[1]})] = 1;
  const auto is_chord = [&](local_id c) {
    return s.table.free_side(c) && !s.inner(s.table.tail(c)) && !s.inner(s.table.head(c));
  };
  const auto corners = static_cast<local_id>(s.table.vertex.size());
  for (local_id c = 0; c < corners; ++c) {
    if (s.table.vertex[c] == no_id)
      continue;
    const local_id a = s.table.tail(c), b = s.table.head(c);
    if (is_chord(c) && s.table.twin[c] > c)
      ++edges[sorted_vertices(label_pair{s.label[a], s.label[b]})];
    // The apex of a vanishing triangle sees both its sides as one edge.
    const local_id apex = s.table.vertex[c];
    if (!s.inner(apex) && s.pole[a] && s.pole[b] && s.label[a] == s.label[b])
      --edges[sorted_vertices(label_pair{s.label[apex], s.label[a]})];
  }
  std::vector<local_id> repeated;
  for (local_id c = 0; c < corners; ++c) {
    if (s.table.vertex[c] == no_id || !is_chord(c) || s.table.twin[c] < c)
      continue;
    const local_id a = s.label[s.table.tail(c)], b = s.label[s.table.head(c)];
    if (a == b || edges[sorted_vertices(label_pair{a, b})] > 1)
      repeated.push_back(c);
  }
  return repeated;
}

/// Splits repeated chords and smooths around the new vertices. What cannot be split is listed in the mesh.
template <class S>
void separate_repeated_edges(patch_state<S>& s, const patch_boundary& boundary, flip_queue& flips,
                             patch_mesh& mesh) {
  for (int round = 0; round < 4; ++round) {
    const std::vector<local_id> chords = repeated_chords(s, boundary);
    if (chords.empty())
      return;
    std::vector<label_pair> sides;
    for (const local_id c : chords)
      sides.push_back({s.table.tail(c), s.table.head(c)});
    std::vector<local_id> added;
    for (std::size_t i = 0; i < chords.size(); ++i)
      if (s.table.tail(chords[i]) == sides[i][0] && s.table.head(chords[i]) == sides[i][1])
        if (const local_id v = split_at_middle(s, chords[i], flips); v != no_id)
          added.push_back(v);
    flips.raise_quality(s, false);
    smoother smooth(s);
    for (const local_id v : added)
      smooth.maximise_worst(v);
  }
  for (const local_id c : repeated_chords(s, boundary))
    mesh.repeated_edges.push_back(
        sorted_vertices(label_pair{s.label[s.table.tail(c)], s.label[s.table.head(c)]}));
}

} // namespace dovetail::detail
