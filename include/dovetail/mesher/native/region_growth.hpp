/// @file
/// Regions of elements that grow until a point sees all of their sides, and so well that none of the elements
/// between is flat but for rounding.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesher/native/kept_entities.hpp"
#include "dovetail/mesher/native/star_points.hpp"
#include "dovetail/triangulation/local_changes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// Exchanges regions for stars, where these have no good center for larger ones, which hold nothing kept.
class region_growth {
public:
  region_growth(local_changes& changes, const kept_entities& kept)
      : changes_(changes), kept_(kept), centers_(changes) {}

  /// Exchanges a region, or a larger one, for a star around a new point there, whose number is returned;
  /// `no_id`, and nothing has changed, when it would not be one.
  local_id insert(vec3 p, std::span<const local_id> elements) {
    star_center center{p};
    begin(elements, no_id, {}, {});
    for (int step = 0;; ++step) {
      center.clearance = centers_.clearance(center, rim_);
      if (center.clearance >= star_centers::least_good || step == most_steps || !grow(p, {}))
        break;
    }
    if (center.clearance == 0) {
      begin(elements, no_id, {}, {});
      center.clearance = centers_.clearance(center, rim_);
      if (center.clearance == 0)
        return no_id;
    }
    std::vector<simplex<3>> fresh;
    centers_.add_star(center, rim_, fresh);
    changes_.replace(region_, fresh);
    return fresh.front()[0];
  }

  /// Finds elements in place of those given, all around the vertex `left`, such that they have no vertex
  /// there but have the sides `closing`, oriented outwards. Adds them to `fresh` and those that go to `old`,
  /// which may hold some that go for another reason. False when none were found. `thorough`: where all other
  /// regions fail, one is tried that takes in one element at a time, always beyond the side that is worst.
  /// (Near a plane face many sides are hardly seen, and with all that is beyond them at once a region leaves
  /// the shape that a point sees.)
  bool refill(std::span<const local_id> elements, local_id left, std::span<const simplex<2>> closing,
              std::vector<local_id>& old, std::vector<simplex<3>>& fresh, bool thorough) {
    star_center best;
    std::vector<local_id> best_region;
    std::vector<simplex<2>> best_rim;
    for (const bool from_left : {true, false}) {
      begin(elements, left, closing, old);
      for (int step = 0; step < most_steps && best.clearance < star_centers::least_good; ++step) {
        if (const star_center center = centers_.best(rim_); center.clearance > best.clearance) {
          best = center;
          best_region = region_;
          best_rim = rim_;
        }
        if (!grow(from_left ? changes_.point(left) : centers_.clear_point(rim_).point, closing))
          break;
      }
    }
    if (best.clearance == 0 && thorough) {
      begin(elements, left, closing, old);
      do {
        best = centers_.best(rim_);
      } while (best.clearance == 0 && grow_by_one(centers_.clear_point(rim_).point, closing));
      best_region = region_;
      best_rim = rim_;
    }
    if (best.clearance == 0)
      return false;
    centers_.add_star(best, best_rim, fresh);
    append(old, best_region);
    return true;
  }

private:
  static constexpr int most_steps = 20;
  static constexpr std::size_t most_elements = 200; // what is larger has no center that sees all of it

  void begin(std::span<const local_id> elements, local_id left, std::span<const simplex<2>> closing,
             std::span<const local_id> gone) {
    left_ = left;
    region_.assign(elements.begin(), elements.end());
    gone_.assign(gone.begin(), gone.end());
    find_rim(closing);
  }
  bool is_in_region(local_id e) const {
    return std::find(region_.begin(), region_.end(), e) != region_.end();
  }
  static bool has(const simplex<2>& t, local_id v) { return t[0] == v || t[1] == v || t[2] == v; }

  /// The sides of the region that are not at the vertex which is left, and the closing ones.
  void find_rim(std::span<const simplex<2>> closing) {
    changes_.find_rim(region_, rim_, &beyond_);
    std::size_t count = 0;
    for (std::size_t k = 0; k < rim_.size(); ++k)
      if (!has(rim_[k], left_)) {
        rim_[count] = rim_[k];
        beyond_[count++] = beyond_[k];
      }
    rim_.resize(count);
    beyond_.resize(count);
    append(rim_, closing);
  }

  /// Takes in the elements beyond sides that a point hardly sees, as far as nothing kept is taken in. False
  /// when there are none.
  bool grow(vec3 p, std::span<const simplex<2>> closing) {
    box3 box;
    for (const auto& [a, b, c] : rim_) {
      if ((a | b | c) < 0)
        return false;
      box.include(changes_.point(a));
    }
    const double limit = star_centers::least_good * box.diagonal();
    std::vector<local_id> candidates;
    for (std::size_t k = 0; k < beyond_.size(); ++k)
      if (!(centers_.height(rim_[k], p) > limit) && !kept_.has(rim_[k][0], rim_[k][1], rim_[k][2]))
        candidates.push_back(beyond_[k]);
    sort_unique(candidates);
    bool any = false;
    for (const local_id e : candidates) {
      if (region_.size() >= most_elements || changes_.is_spent())
        return any;
      any = take_in(e, closing) || any;
    }
    return any;
  }
  /// Takes in one element, beyond the side that a point sees worst of those where that is possible. False
  /// when it sees all sides or there is none.
  bool grow_by_one(vec3 p, std::span<const simplex<2>> closing) {
    std::vector<std::pair<double, local_id>> candidates;
    for (std::size_t k = 0; k < beyond_.size(); ++k) {
      const auto& [a, b, c] = rim_[k];
      if ((a | b | c) < 0)
        return false;
      if (!kept_.has(a, b, c))
        candidates.push_back({centers_.height(rim_[k], p), beyond_[k]});
    }
    sort_all(candidates);
    return region_.size() < most_elements && !changes_.is_spent() &&
           std::any_of(candidates.begin(), candidates.end(),
                       [&](const auto& candidate) { return take_in(candidate.second, closing); });
  }
  /// Takes in an element unless something is against it.
  bool take_in(local_id e, std::span<const simplex<2>> closing) {
    if (changes_.mesh().is_ghost(e) || is_in_region(e) ||
        std::find(gone_.begin(), gone_.end(), e) != gone_.end() ||
        (left_ != no_id && changes_.has_vertex(e, left_)))
      return false;
    region_.push_back(e);
    find_rim(closing);
    if (!holds_kept())
      return true;
    region_.pop_back();
    find_rim(closing);
    return false;
  }

  /// Whether the element that came last hides a kept triangle or edge, or a vertex, in the region.
  bool holds_kept() {
    const local_id last = region_.back();
    changes_.count_work(10 * rim_.size());
    rim_edges_.clear();
    rim_vertices_.clear();
    for (const auto& side : rim_)
      for (std::size_t k = 0; k < 3; ++k) {
        rim_edges_.push_back(sorted_pair(side[k], side[(k + 1) % 3]));
        rim_vertices_.push_back(side[k]);
      }
    sort_unique(rim_edges_);
    sort_unique(rim_vertices_);
    const auto& cell = changes_.mesh()[last];
    for (std::size_t i = 0; i < 4; ++i) {
      if (!std::binary_search(rim_vertices_.begin(), rim_vertices_.end(), cell.vertices[i]))
        return true;
      const auto side = changes_.side_vertices(last, i);
      if (is_in_region(triangulation<3>::element_of(cell.across[i])) && kept_.has(side[0], side[1], side[2]))
        return true;
    }
    return std::any_of(numbering::ridges<3>.begin(), numbering::ridges<3>.end(), [&](const auto& ridge) {
      const vertex_pair edge = sorted_pair(cell.vertices[ridge[0]], cell.vertices[ridge[1]]);
      return kept_.has(edge[0], edge[1]) && !std::binary_search(rim_edges_.begin(), rim_edges_.end(), edge);
    });
  }

  local_changes& changes_;
  const kept_entities& kept_;
  star_centers centers_;
  local_id left_ = no_id;
  std::vector<local_id> region_, gone_, beyond_;
  std::vector<simplex<2>> rim_;
  std::vector<vertex_pair> rim_edges_;
  std::vector<local_id> rim_vertices_;
};

} // namespace dovetail::detail
