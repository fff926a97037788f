/// @file
/// What is on the other side of a solid, or of a gap: searched among samples of faces.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/sizing/surface_samples.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::sizing {

/// Finds, for a sample, the nearest sample on the other side of the solid, or of the gap, beside it.
///
/// Each solid, and what is outside of all, has a tree of the samples around it with bounds of their normals:
/// of an assembly of many small solids, or of faces that look elsewhere, a search sees next to nothing.
class facing_search {
public:
  facing_search(std::vector<surface_sample> samples, const geometry_topology& topology);

  /// The samples that it searches, those that are near each other mostly side by side.
  const std::vector<surface_sample>& samples() const { return samples_; }

  /// Of the samples that face `from` through what is on its side (0: behind its face, 1: in front), within a
  /// height of `reach`, the lowest, and of those on one plane the one most nearly above; `slack` is the
  /// distance between samples. Null when there is none.
  const surface_sample* find(const surface_sample& from, std::size_t side, double reach, double slack) const;

private:
  struct query {
    vec3 point;
    vec3 direction; ///< into what is looked through
    double height;  ///< the lowest so far
    double offset;  ///< of the best so far, along the plane
    double slack;
    const surface_sample* best;
  };

  /// A sample at which a solid ends.
  struct end {
    local_id sample;
    vec3 outwards; ///< the normal that points out of the solid
  };

  /// Where one solid, or what is outside of all, ends.
  struct ends {
    explicit ends(const std::vector<surface_sample>& samples, std::vector<end> of_one);

    std::vector<end> list; ///< in the order of the tree
    box_tree tree;
    std::vector<box3> outwards; ///< bounds of the normals below each node
  };

  static constexpr std::size_t leaf_size = 8;
  static constexpr double turned_away = 0.8; ///< least cosine between normals; across an edge it is less
  static constexpr double aside = 0.5;       ///< largest offset along the plane per height
  static constexpr double level = 1 - 1e-9;  ///< heights of this ratio and more are the same

  /// Whether something so high, or higher, and so far aside, or farther, is better than the best so far.
  static bool may_be_better(double height, double offset, const query& q);

  /// Whether a box may hold a point above the plane, low enough and not too far aside.
  static bool may_hold(const box3& box, const query& q);

  /// Whether one of the normals in a box may look along the direction.
  static bool may_look_away(const box3& normals, const query& q);

  void consider(const end& e, query& q) const;

  std::vector<surface_sample> samples_;
  const geometry_topology& topology_;
  std::vector<ends> ends_; ///< of what is outside, then of each solid
};

} // namespace dovetail::sizing

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/facing_search.ipp"
#endif
