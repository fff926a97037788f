/// @file
/// Merges subdomains: where their interfaces cross the surface, or where a mesher fails.
#pragma once

#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Merges subdomains of a decomposition in place and numbers them without gaps, in order of their smallest
/// member. `sizes` holds, per subdomain, how many original ones it is made of, before and after.
/// About linear. Throws nothing.
/// \param subdomain_of_element per element its subdomain, which changes
/// \param sizes per subdomain, changes
/// \param merges pairs of subdomains, numbered as before
void merge_subdomains(std::vector<local_id>& subdomain_of_element, std::vector<local_id>& sizes,
                      const std::vector<std::array<local_id, 2>>& merges);

/// What has been merged of a decomposition, in all rounds and after failures of pieces, and how much may be.
class merge_account {
public:
  /// `largest_fraction` of the subdomains may be merged into others; two of eight and one of fewer always
  /// may.
  merge_account(local_id subdomains, double largest_fraction);

  local_id subdomains() const { return static_cast<local_id>(sizes_.size()); } ///< how many there are now
  /// Subdomains that are no more, since their interfaces crossed something or no attempt could mesh them.
  local_id merged() const { return started_with_ - subdomains(); }
  /// How many original subdomains the largest one is made of.
  local_id largest() const { return *std::max_element(sizes_.begin(), sizes_.end()); }

  /// What to say where these merges would be more than is allowed; empty where they would not.
  std::string refusal_of(const std::vector<std::array<local_id, 2>>& merges) const;
  /// `merge_subdomains`, counted.
  void merge(std::vector<local_id>& subdomain_of_element, const std::vector<std::array<local_id, 2>>& merges);

private:
  std::vector<local_id> sizes_; ///< per subdomain: how many original ones it is made of
  local_id started_with_;
  double allowed_;
};

namespace detail {

/// Area of a triangle or length of an edge.
template <int D>
double measure_of_side(std::span<const vec3> points, const simplex<D - 1>& side) {
  const auto at = [&](std::size_t k) { return points[side[k]]; };
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

#ifndef DOVETAIL_COMPILED
#include "dovetail/intersection/merge_subdomains.ipp"
#endif
