/// @file
/// The elements that a triangle passes through, exchanged for two stars, one on each side of it.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesher/native/kept_entities.hpp"
#include "dovetail/mesher/native/recovery_flips.hpp"
#include "dovetail/mesher/native/star_points.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// The region of some elements, cut in two by a triangle whose edges are on its boundary.
class cavity_division {
public:
  cavity_division(local_changes& changes, const kept_entities& kept, const simplex<2>& cut,
                  std::span<const local_id> elements)
      : changes_(changes), kept_(kept), cut_(cut), elements_(elements) {}

  /// Exchanges the elements for a star on each side of the triangle. False, and nothing has changed, when the
  /// region is not of that kind, holds something that is kept, or no two points see all of their sides.
  bool run() {
    find_rim();
    if (!keeps_all() || !divide())
      return false;
    const std::size_t points = changes_.mesh().points.size();
    std::vector<simplex<3>> fresh;
    star_centers centers(changes_);
    for (const auto& part : parts_) {
      const star_center center = centers.best(part);
      if (center.clearance == 0) {
        changes_.drop_points(points);
        return false;
      }
      centers.add_star(center, part, fresh);
    }
    changes_.replace(elements_, fresh);
    return true;
  }

private:
  void find_rim() {
    changes_.find_rim(elements_, rim_);
    for (const auto& side : rim_) {
      rim_triangles_.push_back(sorted_vertices(side));
      for (std::size_t k = 0; k < 3; ++k) {
        rim_edges_.push_back(sorted_pair(side[k], side[(k + 1) % 3]));
        rim_vertices_.push_back(side[k]);
      }
    }
    sort_all(rim_triangles_);
    sort_unique(rim_edges_);
    sort_unique(rim_vertices_);
  }
  template <class Entity>
  static bool is_among(const std::vector<Entity>& sorted, const Entity& one) {
    return std::binary_search(sorted.begin(), sorted.end(), one);
  }
  /// No vertex, kept edge or kept triangle is inside the region.
  bool keeps_all() const {
    for (const local_id e : elements_) {
      for (const auto& ridge : numbering::ridges<3>) {
        const local_id u = changes_.mesh()[e].vertices[ridge[0]], v = changes_.mesh()[e].vertices[ridge[1]];
        if (u < 0 || v < 0 || !is_among(rim_vertices_, u) || !is_among(rim_vertices_, v) ||
            (kept_.has(u, v) && !is_among(rim_edges_, sorted_pair(u, v))))
          return false;
      }
      for (std::size_t i = 0; i < 4; ++i)
        if (const auto side = changes_.side_vertices(e, i);
            kept_.has(side[0], side[1], side[2]) && !is_among(rim_triangles_, sorted_vertices(side)))
          return false;
    }
    return true;
  }
  bool is_cut_edge(const vertex_pair& e) const {
    return e == sorted_pair(cut_[0], cut_[1]) || e == sorted_pair(cut_[1], cut_[2]) ||
           e == sorted_pair(cut_[2], cut_[0]);
  }
  /// Sorts the sides into the two parts, closed by the triangle.
  bool divide() {
    std::vector<std::pair<vertex_pair, local_id>> by_edge;
    for (std::size_t s = 0; s < rim_.size(); ++s)
      for (std::size_t k = 0; k < 3; ++k)
        if (const vertex_pair e = sorted_pair(rim_[s][k], rim_[s][(k + 1) % 3]); !is_cut_edge(e))
          by_edge.push_back({e, static_cast<local_id>(s)});
    sort_all(by_edge);
    disjoint_sets sets(rim_.size());
    for (std::size_t k = 1; k < by_edge.size(); ++k)
      if (by_edge[k].first == by_edge[k - 1].first)
        sets.unite(by_edge[k].second, by_edge[k - 1].second);
    const auto numbered = sets.number_sets();
    if (numbered.count != 2)
      return false;
    for (std::size_t s = 0; s < rim_.size(); ++s)
      parts_[numbered.of_member[s]].push_back(rim_[s]);
    return close(parts_[0]) && close(parts_[1]);
  }
  /// Adds the triangle, oriented against the sides at its edges. False when these do not agree.
  bool close(std::vector<simplex<2>>& part) const {
    int along = 0, against = 0;
    for (const auto& side : part)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
          along += side[k] == cut_[c] && side[(k + 1) % 3] == cut_[(c + 1) % 3];
          against += side[(k + 1) % 3] == cut_[c] && side[k] == cut_[(c + 1) % 3];
        }
    if (along + against != 3 || (along != 0 && against != 0))
      return false;
    part.push_back(along == 3 ? simplex<2>{cut_[0], cut_[2], cut_[1]} : cut_);
    return true;
  }

  local_changes& changes_;
  const kept_entities& kept_;
  simplex<2> cut_;
  std::span<const local_id> elements_;
  std::vector<simplex<2>> rim_, rim_triangles_; // oriented outwards; their vertices in growing order
  std::vector<vertex_pair> rim_edges_;
  std::vector<local_id> rim_vertices_;
  std::array<std::vector<simplex<2>>, 2> parts_;
};

} // namespace dovetail::detail
