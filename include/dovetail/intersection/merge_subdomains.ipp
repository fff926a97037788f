/// @file
/// What `merge_subdomains.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/intersection/merge_subdomains.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE void merge_subdomains(std::vector<local_id>& subdomain_of_element,
                                      std::vector<local_id>& sizes,
                                      const std::vector<std::array<local_id, 2>>& merges) {
  std::vector<local_id> root(sizes.size());
  std::iota(root.begin(), root.end(), local_id{0});
  const auto find = [&](local_id s) {
    while (root[s] != s)
      s = root[s];
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
    merged_sizes[number[s]] += sizes[s];
  }
  for (local_id& s : subdomain_of_element)
    s = number[s];
  sizes = std::move(merged_sizes);
}

DOVETAIL_INLINE merge_account::merge_account(local_id subdomains, double largest_fraction)
    : sizes_(static_cast<std::size_t>(subdomains), 1), started_with_(subdomains),
      allowed_(std::max(largest_fraction * subdomains, std::clamp(subdomains / 4, 1, 2) * 1.0)) {}

DOVETAIL_INLINE std::string
merge_account::refusal_of(const std::vector<std::array<local_id, 2>>& merges) const {
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

DOVETAIL_INLINE void merge_account::merge(std::vector<local_id>& subdomain_of_element,
                                          const std::vector<std::array<local_id, 2>>& merges) {
  merge_subdomains(subdomain_of_element, sizes_, merges);
}

} // namespace dovetail
