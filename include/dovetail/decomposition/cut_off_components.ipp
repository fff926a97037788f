/// @file
/// What `cut_off_components.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/decomposition/cut_off_components.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<local_id> cut_off_components::cut_off_by(std::span<const local_id> leaving,
                                                                     double part_weight) {
  if (plant(leaving) < 2 || grow(false) == 1)
    return {};
  double rest = part_weight;
  for (const local_id s : leaving)
    rest -= weight(s);
  std::vector<std::size_t> found; // in order of their first seeds
  std::size_t unfinished = components_.size();
  for (std::size_t k = 0; k < leader_.size(); ++k) {
    const std::size_t p = leader(k);
    if (std::find(found.begin(), found.end(), p) != found.end())
      continue;
    found.push_back(p);
    if (components_[p].is_complete())
      rest -= components_[p].weight;
    else
      unfinished = p;
  }
  if (unfinished < components_.size())
    components_[unfinished].weight = rest;
  const std::size_t heaviest =
      *std::max_element(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
        return components_[a].weight < components_[b].weight;
      });
  return members_but_of(heaviest, leaving);
}

DOVETAIL_INLINE std::size_t cut_off_components::plant(std::span<const local_id> leaving) {
  part_searched_ = part_[leaving[0]];
  left_ = next_mark_;
  for (const local_id s : leaving)
    mark_[s] = left_;
  seeds_.clear();
  for (const local_id s : leaving)
    for (const local_id other : graph_.row(s))
      if (part_[other] == part_searched_ && mark_[other] < left_) {
        seeds_.push_back(other);
        mark_[other] = left_ + seeds_.size();
      }
  next_mark_ += seeds_.size() + 1;
  leader_.resize(seeds_.size());
  if (components_.size() < seeds_.size())
    components_.resize(seeds_.size());
  for (std::size_t k = 0; k < seeds_.size(); ++k) {
    leader_[k] = k;
    components_[k].members.assign(1, seeds_[k]);
    components_[k].next = 0;
    components_[k].weight = weight(seeds_[k]);
  }
  return seeds_.size();
}

DOVETAIL_INLINE std::size_t cut_off_components::grow(bool until_first) {
  std::size_t left = seeds_.size();
  std::size_t complete = 0;
  while (complete + 1 < left && !(until_first && complete > 0))
    for (std::size_t k = 0; k < seeds_.size() && left > 1; ++k) {
      if (leader_[k] != k || components_[k].is_complete())
        continue;
      left -= search_next(k);
      if (components_[k].is_complete())
        ++complete;
    }
  return left;
}

DOVETAIL_INLINE std::size_t cut_off_components::search_next(std::size_t k) {
  std::size_t met = 0;
  growing_component& component = components_[k];
  const local_id from = component.members[component.next++];
  for (const local_id other : graph_.row(from)) {
    std::size_t& mark = mark_[other];
    if (part_[other] != part_searched_ || mark == left_)
      continue;
    if (mark < left_) {
      mark = left_ + 1 + k;
      component.members.push_back(other);
      component.weight += weight(other);
    } else if (const std::size_t j = leader(mark - left_ - 1); j != k) {
      join(j, k);
      ++met;
    }
  }
  return met;
}

DOVETAIL_INLINE void cut_off_components::join(std::size_t j, std::size_t k) {
  leader_[j] = k;
  growing_component& into = components_[k];
  growing_component& from = components_[j];
  into.weight += from.weight;
  if (from.members.size() - from.next > into.members.size() - into.next) {
    std::swap(from.members, into.members);
    std::swap(from.next, into.next);
  }
  into.members.insert(into.members.end(), from.members.begin() + static_cast<std::ptrdiff_t>(from.next),
                      from.members.end());
}

DOVETAIL_INLINE std::vector<local_id> cut_off_components::members_but_of(std::size_t heaviest,
                                                                         std::span<const local_id> leaving) {
  const std::size_t seen = next_mark_++;
  for (const local_id s : leaving)
    mark_[s] = seen;
  std::vector<local_id> members;
  for (std::size_t k = 0; k < seeds_.size(); ++k) {
    if (leader(k) == heaviest || mark_[seeds_[k]] == seen)
      continue;
    mark_[seeds_[k]] = seen;
    members.push_back(seeds_[k]);
    for (std::size_t m = members.size() - 1; m < members.size(); ++m)
      for (const local_id other : graph_.row(members[m]))
        if (part_[other] == part_searched_ && mark_[other] != seen) {
          mark_[other] = seen;
          members.push_back(other);
        }
  }
  return members;
}

} // namespace dovetail
