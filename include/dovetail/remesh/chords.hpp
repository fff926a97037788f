/// @file
/// Chords: inner sides of a triangulation that join two points of its boundary.
#pragma once

#include "dovetail/mesh/simplex.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/remesh/patch.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace dovetail {

/// Tells which sides are chords. The boundary's points come first among those of the triangulation.
class chord_finder {
public:
  using label_pair = std::array<local_id, 2>; ///< the smaller first

  explicit chord_finder(const patch_boundary& boundary) : chord_finder(boundary.labels, boundary.segments) {}
  chord_finder(std::vector<local_id> labels, std::span<const simplex<1>> segments);
  /// Points that are their own labels.
  chord_finder(std::size_t boundary_points, std::span<const simplex<1>> segments)
      : chord_finder(counted(boundary_points), segments) {}

  /// The labels of the ends of a chord; none for other sides, among them those whose ends have one label, or
  /// the labels of a segment.
  std::optional<label_pair> operator()(local_id a, local_id b) const {
    const auto frozen = static_cast<local_id>(labels_.size());
    if (a >= frozen || b >= frozen)
      return std::nullopt;
    const label_pair side = labels_of(a, b);
    if (side[0] == side[1] || std::binary_search(segments_.begin(), segments_.end(), side))
      return std::nullopt;
    return side;
  }

  /// Calls `visit(t, labels)` for every side of a triangle t that is a chord: mostly twice for each.
  template <class Visit>
  void for_each(std::span<const simplex<2>> triangles, const Visit& visit) const {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto chord = (*this)(triangles[t][k], triangles[t][(k + 1) % 3]))
          visit(t, *chord);
  }

  /// The chords by their points, sorted, each once.
  std::vector<simplex<1>> all(std::span<const simplex<2>> triangles) const;

private:
  static std::vector<local_id> counted(std::size_t points);
  label_pair labels_of(local_id a, local_id b) const {
    return sorted_vertices(label_pair{labels_[a], labels_[b]});
  }

  std::vector<local_id> labels_;     ///< of the boundary's points
  std::vector<label_pair> segments_; ///< sorted
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/remesh/chords.ipp"
#endif
