/// @file
/// The elements that a triangle passes through, exchanged for two stars, one on each side of it.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
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
  using edge = std::array<local_id, 2>;
  static edge sorted(local_id u, local_id v) { return {std::min(u, v), std::max(u, v)}; }

  /// Finds the sides of the region, oriented outwards, and tells whether those inside may go.
  void find_rim() {
    const auto& mesh = changes_.mesh();
    std::vector<local_id> inside(elements_.begin(), elements_.end());
    sort_all(inside);
    for (const local_id e : elements_)
      for (std::size_t i = 0; i < 4; ++i) {
        simplex<2> side{};
        for (std::size_t k = 0; k < 3; ++k)
          side[k] = mesh[e].vertices[numbering::sides<3>[i][k]];
        const local_id beyond = triangulation<3>::element_of(mesh[e].across[i]);
        if (!std::binary_search(inside.begin(), inside.end(), beyond))
          rim_.push_back(side);
        else if (side[0] >= 0 && side[1] >= 0 && side[2] >= 0)
          loses_kept_ = loses_kept_ || kept_.has(side[0], side[1], side[2]);
      }
    for (const auto& side : rim_)
      for (std::size_t k = 0; k < 3; ++k) {
        rim_edges_.push_back(sorted(side[k], side[(k + 1) % 3]));
        rim_vertices_.push_back(side[k]);
      }
    sort_unique(rim_edges_);
    sort_unique(rim_vertices_);
  }
  /// No vertex, kept edge or kept triangle is inside the region.
  bool keeps_all() const {
    if (loses_kept_)
      return false;
    for (const local_id e : elements_)
      for (const auto& ridge : numbering::ridges<3>) {
        const local_id u = changes_.mesh()[e].vertices[ridge[0]], v = changes_.mesh()[e].vertices[ridge[1]];
        if (u < 0 || v < 0 || !std::binary_search(rim_vertices_.begin(), rim_vertices_.end(), u) ||
            !std::binary_search(rim_vertices_.begin(), rim_vertices_.end(), v))
          return false;
        if (kept_.has(u, v) && !std::binary_search(rim_edges_.begin(), rim_edges_.end(), sorted(u, v)))
          return false;
      }
    return true;
  }
  bool is_cut_edge(const edge& e) const {
    return e == sorted(cut_[0], cut_[1]) || e == sorted(cut_[1], cut_[2]) || e == sorted(cut_[2], cut_[0]);
  }
  /// Sorts the sides into the two parts, closed by the triangle.
  bool divide() {
    std::vector<std::pair<edge, local_id>> by_edge;
    for (std::size_t s = 0; s < rim_.size(); ++s)
      for (std::size_t k = 0; k < 3; ++k)
        if (const edge e = sorted(rim_[s][k], rim_[s][(k + 1) % 3]); !is_cut_edge(e))
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
  std::vector<simplex<2>> rim_;
  std::vector<edge> rim_edges_;
  std::vector<local_id> rim_vertices_;
  std::array<std::vector<simplex<2>>, 2> parts_;
  bool loses_kept_ = false;
};

} // namespace dovetail::detail
