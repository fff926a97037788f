/// @file
/// Inner edges of a region that must not be, whoever made them: they are split.
#pragma once

#include "dovetail/remesh/chords.hpp"
#include "dovetail/remesh/kept_lines.hpp"
#include "dovetail/remesh/surface_region.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// How the lines of a region are listed and passed, by labels: the two sides of a seam count as one line, and
/// a pole's segments as none.
inline line_passages passages_of(const patch_boundary& boundary, const patch_mesh& made) {
  std::vector<simplex<1>> listed, passed;
  const auto add_to = [&](std::vector<simplex<1>>& edges) {
    return [&](const simplex<1>& edge) {
      if (const simplex<1> named{boundary.labels[edge[0]], boundary.labels[edge[1]]}; named[0] != named[1])
        edges.push_back(named);
    };
  };
  std::for_each(boundary.segments.begin(), boundary.segments.end(), add_to(listed));
  for_each_edge_before(static_cast<local_id>(boundary.labels.size()), made.triangles, add_to(passed));
  return {std::move(listed), std::move(passed)};
}

/// Splits inner edges in the middle: those that join forbidden labels, two labels a second time, or a label
/// to itself; and those that join a label to an inner point a second time, from the other side of a seam.
class unwanted_chord_splitter {
public:
  using label_pair = chord_finder::label_pair;

  unwanted_chord_splitter(const any_surface& surface, const patch_boundary& boundary, patch_mesh& made)
      : surface_(surface), boundary_(boundary), made_(made), unwanted_(boundary.forbidden_edges),
        frozen_(static_cast<local_id>(boundary.labels.size())) {
    append(unwanted_, passages_of(boundary, made).repeated());
    append(unwanted_, made.repeated_edges);
    for_each_edge_before(frozen_, made.triangles, [&](const simplex<1>& edge) {
      if (const local_id label = boundary.labels[edge[0]]; label == boundary.labels[edge[1]])
        unwanted_.push_back({label, label});
    });
    for (label_pair& pair : unwanted_)
      pair = sorted_vertices(pair);
    sort_unique(unwanted_);
    find_repeated_spokes();
  }

  void run() {
    if (unwanted_.empty() && spokes_.empty())
      return;
    name_segments();
    for (std::size_t t = 0; t < made_.triangles.size(); ++t) // their number grows
      for (std::size_t k = 0; k < 3;)
        k = is_unwanted(made_.triangles[t][k], made_.triangles[t][(k + 1) % 3]) ? split(t, k) : k + 1;
    made_.repeated_edges.clear();
  }

private:
  /// Segments by their ends; of ends with one label and the same parameters triangles name the first.
  void name_segments() {
    std::map<std::tuple<local_id, double, double>, local_id> first;
    const auto named = [&](local_id v) {
      return first.try_emplace({boundary_.labels[v], boundary_.uv[v].x, boundary_.uv[v].y}, v).first->second;
    };
    for (local_id v = 0; v < frozen_; ++v)
      named(v);
    for (const auto& [a, b] : boundary_.segments)
      segments_.push_back(sorted_vertices(simplex<1>{named(a), named(b)}));
    sort_all(segments_);
  }

  /// Edges of one label and an inner point that triangles pass twice in one direction; not at poles, where
  /// several edges in the parameter plane are one.
  void find_repeated_spokes() {
    std::vector<local_id> labels = boundary_.labels;
    sort_all(labels);
    if (std::adjacent_find(labels.begin(), labels.end()) == labels.end())
      return;
    std::vector<local_id> poles;
    for (const auto& [a, b] : boundary_.segments)
      if (boundary_.labels[a] == boundary_.labels[b])
        poles.push_back(boundary_.labels[a]);
    sort_all(poles);
    std::vector<std::array<local_id, 3>> passages; // the label, the inner point, 1 for a way outwards
    for (const simplex<2>& triangle : made_.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const local_id a = triangle[k], b = triangle[(k + 1) % 3];
        if ((a < frozen_) != (b < frozen_))
          passages.push_back({boundary_.labels[std::min(a, b)], std::max(a, b), a < b ? 1 : 0});
      }
    sort_all(passages);
    for (std::size_t i = 1; i < passages.size(); ++i)
      if (passages[i] == passages[i - 1] && !std::binary_search(poles.begin(), poles.end(), passages[i][0]))
        spokes_.push_back({passages[i][0], passages[i][1]});
    sort_unique(spokes_);
  }

  bool is_unwanted(local_id a, local_id b) const {
    if (a >= frozen_ && b >= frozen_)
      return false;
    if (a >= frozen_ || b >= frozen_)
      return std::binary_search(spokes_.begin(), spokes_.end(),
                                label_pair{boundary_.labels[std::min(a, b)], std::max(a, b)});
    const auto pair = sorted_vertices(label_pair{boundary_.labels[a], boundary_.labels[b]});
    return std::binary_search(unwanted_.begin(), unwanted_.end(), pair) &&
           !std::binary_search(segments_.begin(), segments_.end(), sorted_vertices(simplex<1>{a, b}));
  }

  /// Splits side k of triangle t; returns the side to go on with.
  std::size_t split(std::size_t t, std::size_t k) {
    const simplex<2> whole = made_.triangles[t];
    const local_id a = whole[k], b = whole[(k + 1) % 3], c = whole[(k + 2) % 3];
    const local_id m = middle(a, b);
    made_.triangles[t] = {a, m, c};
    made_.triangles.push_back({m, b, c});
    return 0;
  }

  /// The same for both triangles of an edge.
  local_id middle(local_id a, local_id b) {
    const auto next = frozen_ + static_cast<local_id>(made_.inner_uv.size());
    const auto [found, is_new] = middles_.try_emplace(sorted_vertices(std::array{a, b}), next);
    if (is_new) {
      made_.inner_uv.push_back(0.5 * (uv(a) + uv(b)));
      made_.inner_points.push_back(surface_.frame(made_.inner_uv.back()).point);
    }
    return found->second;
  }

  vec2 uv(local_id v) const { return v < frozen_ ? boundary_.uv[v] : made_.inner_uv[v - frozen_]; }

  const any_surface& surface_;
  const patch_boundary& boundary_;
  patch_mesh& made_;
  std::vector<label_pair> unwanted_; ///< by labels
  std::vector<label_pair> spokes_;   ///< a label and an inner point
  local_id frozen_;
  std::vector<simplex<1>> segments_;
  std::map<std::array<local_id, 2>, local_id> middles_;
};

} // namespace dovetail::detail
