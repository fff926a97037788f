/// @file
/// Merges subdomains: where their interfaces cross the surface, or where a mesher fails.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Merges subdomains of a decomposition in place and numbers them without gaps, in order of their smallest
/// member. `sizes` holds, per subdomain, how many original ones it is made of, before and after.
inline void merge_subdomains(std::vector<local_id>& subdomain_of_element, std::vector<local_id>& sizes,
                             const std::vector<std::array<local_id, 2>>& merges) {
  std::vector<local_id> root(sizes.size());
  std::iota(root.begin(), root.end(), local_id{0});
  const auto find = [&](local_id s) {
    while (root[static_cast<std::size_t>(s)] != s)
      s = root[static_cast<std::size_t>(s)];
    return static_cast<std::size_t>(s);
  };
  for (const auto& [a, b] : merges) {
    const std::size_t ra = find(a), rb = find(b);
    root[std::max(ra, rb)] = static_cast<local_id>(std::min(ra, rb));
  }
  std::vector<local_id> number(sizes.size(), no_id), merged_sizes;
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const std::size_t r = find(static_cast<local_id>(s));
    if (number[r] == no_id) { // the root is the smallest member, so it comes first
      number[r] = static_cast<local_id>(merged_sizes.size());
      merged_sizes.push_back(0);
    }
    number[s] = number[r];
    merged_sizes[static_cast<std::size_t>(number[s])] += sizes[s];
  }
  for (local_id& s : subdomain_of_element)
    s = number[static_cast<std::size_t>(s)];
  sizes = std::move(merged_sizes);
}

/// What has been merged of a decomposition, in all rounds and after failures of pieces, and how much may be.
class merge_account {
public:
  /// `largest_fraction` of the subdomains may be merged into others; two of eight and one of fewer always
  /// may.
  merge_account(local_id subdomains, double largest_fraction)
      : sizes_(static_cast<std::size_t>(subdomains), 1), started_with_(subdomains),
        allowed_(std::max(largest_fraction * subdomains, std::clamp(subdomains / 4, 1, 2) * 1.0)) {}

  local_id subdomains() const { return static_cast<local_id>(sizes_.size()); } ///< how many there are now
  /// Subdomains that are no more, since their interfaces crossed something or no attempt could mesh them.
  local_id merged() const { return started_with_ - subdomains(); }
  /// How many original subdomains the largest one is made of.
  local_id largest() const { return *std::max_element(sizes_.begin(), sizes_.end()); }

  /// What to say where these merges would be more than is allowed; empty where they would not.
  std::string refusal_of(const std::vector<std::array<local_id, 2>>& merges) const {
    std::vector<local_id> of_element;
    auto sizes = sizes_;
    merge_subdomains(of_element, sizes, merges);
    const auto merged = started_with_ - static_cast<local_id>(sizes.size());
    if (merged <= allowed_)
      return {};
    return std::to_string(merged) + " of " + std::to_string(started_with_) +
           " subdomains would have to be merged, " + std::to_string(static_cast<local_id>(allowed_)) +
           " may be";
  }
  /// `merge_subdomains`, counted.
  void merge(std::vector<local_id>& subdomain_of_element,
             const std::vector<std::array<local_id, 2>>& merges) {
    merge_subdomains(subdomain_of_element, sizes_, merges);
  }

private:
  std::vector<local_id> sizes_; ///< per subdomain: how many original ones it is made of
  local_id started_with_;
  double allowed_;
};

namespace detail {

/// Area of a triangle or length of an edge.
template <int D>
double measure_of_side(std::span<const vec3> points, const simplex<D - 1>& side) {
  const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(side[k])]; };
  if constexpr (D == 3)
    return 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)));
  else
    return distance(at(0), at(1));
}

} // namespace detail

/// The neighbours that failed subdomains are merged with: of the same material, across the largest shared
/// interface by area or length, ties to the smaller number. A subdomain without such a neighbour is left out.
/// In D = 2 subsurfaces may be merged across CAD curves. Linear; nothing is done when none has failed.
template <int D>
std::vector<std::array<local_id, 2>> merges_of_failed(const simplicial_skeleton<D>& skeleton,
                                                      const std::vector<local_id>& failed) {
  if (failed.empty())
    return {};
  const std::set<local_id> has_failed(failed.begin(), failed.end());
  std::map<std::array<local_id, 2>, double> shared; // {failed, neighbour}
  const auto& sides = skeleton.sides;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [a, b] = skeleton.subdomains[s];
    if ((D == 3 && skeleton.side_hosts[s] != no_id) || b == no_id || a == b)
      continue;
    const double measure = detail::measure_of_side<D>(skeleton.points, sides[s]);
    for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)})
      if (has_failed.contains(one))
        shared[{one, other}] += measure;
  }
  std::vector<std::array<local_id, 2>> merges;
  for (const local_id s : failed) {
    local_id best = no_id;
    double largest = 0;
    for (auto it = shared.lower_bound({s, 0}); it != shared.end() && it->first[0] == s; ++it)
      if (it->second > largest) {
        largest = it->second;
        best = it->first[1];
      }
    if (best != no_id)
      merges.push_back({std::min(s, best), std::max(s, best)});
  }
  return merges;
}

} // namespace dovetail
