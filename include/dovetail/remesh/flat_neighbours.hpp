/// @file
/// Which chords of curved faces lie in a flat face: those between two points of its boundary. A triangle at
/// such a chord may lie in the flat face as a whole, as the one at the tip of half a cone.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/geometry/coplanar.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The flat faces at points, which have numbers.
template <geometry_model Geometry>
class flat_neighbours {
public:
  /// Only of these points it will be asked.
  flat_neighbours(const Geometry& model, std::vector<local_id> points)
      : model_(model), points_(std::move(points)) {
    sort_unique(points_);
  }

  bool is_flat(local_id face) { return plane_of(face).has_value(); }

  /// A face, and the points of its boundary. Whether it is flat is asked of the model only where that
  /// matters.
  void add(local_id face, std::span<const local_id> boundary) {
    for (const local_id p : boundary)
      if (std::binary_search(points_.begin(), points_.end(), p) && is_flat(face))
        faces_at_[p].push_back(face);
  }

  /// Whether both points are on a flat face, or on two in one plane.
  bool share_a_plane(local_id p, local_id q) {
    const auto at_p = faces_at_.find(p), at_q = faces_at_.find(q);
    if (at_p == faces_at_.end() || at_q == faces_at_.end())
      return false;
    return std::any_of(at_p->second.begin(), at_p->second.end(), [&](local_id f) {
      return std::any_of(at_q->second.begin(), at_q->second.end(), [&](local_id g) {
        return f == g ||
               are_coplanar(*plane_of(f), *plane_of(g), model_.bounds().diagonal(), coplanar_tolerance);
      });
    });
  }

private:
  const std::optional<surface_frame>& plane_of(local_id face) {
    const auto [found, is_new] = planes_.try_emplace(face);
    if (is_new)
      found->second = plane_of_face(model_, face);
    return found->second;
  }

  const Geometry& model_;
  std::vector<local_id> points_; ///< sorted
  std::map<local_id, std::vector<local_id>> faces_at_;
  std::map<local_id, std::optional<surface_frame>> planes_;
};

} // namespace dovetail::detail
