/// @file
/// What a part falls into when some of its super-elements leave it.
#pragma once

#include "dovetail/graph/csr_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// Searches a part from the neighbours of those that leave, from all of them at the same pace. So what it
/// costs to tell that a part stays connected is the way around those that leave, and that it does not, about
/// the size of the smaller components, however large the part is.
///
/// `graph` and `part` must outlive the search; `part` may change between calls. Those that leave are all of
/// one part.
class cut_off_components {
public:
  cut_off_components(const csr_graph& graph, std::span<const local_id> part)
      : graph_(graph), part_(part), mark_(part.size(), 0) {}

  /// Are the neighbours, in the part, of those that leave connected with each other without them? False when
  /// there are none.
  bool stays_connected(std::span<const local_id> leaving) { return plant(leaving) > 0 && grow(true) == 1; }

  /// The super-elements of all components but the heaviest, of a part of the given weight.
  std::vector<local_id> cut_off_by(std::span<const local_id> leaving, double part_weight) {
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

private:
  struct growing_component {
    std::vector<local_id> members; ///< reached; those from `next` on have not been searched from
    std::size_t next = 0;
    double weight = 0;

    bool is_complete() const { return next == members.size(); }
  };

  template <class Id>
  static std::size_t index(Id id) {
    return static_cast<std::size_t>(id);
  }
  double weight(local_id super) const { return graph_.node_weights[index(super)]; }

  /// One component for each neighbour of those that leave; returns how many these are.
  std::size_t plant(std::span<const local_id> leaving) {
    part_searched_ = part_[index(leaving[0])];
    left_ = next_mark_;
    for (const local_id s : leaving)
      mark_[index(s)] = left_;
    seeds_.clear();
    for (const local_id s : leaving)
      for (const local_id other : graph_.row(s))
        if (part_[index(other)] == part_searched_ && mark_[index(other)] < left_) {
          seeds_.push_back(other);
          mark_[index(other)] = left_ + seeds_.size();
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

  std::size_t leader(std::size_t seed) const {
    while (leader_[seed] != seed)
      seed = leader_[seed];
    return seed;
  }

  /// Grows the planted components, which become one where they meet, until one is left, or all others are
  /// complete
  /// (`until_first`: or any is). Returns how many are left.
  std::size_t grow(bool until_first) {
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

  /// Goes on with one member of a component; returns how many other components it met.
  std::size_t search_next(std::size_t k) {
    std::size_t met = 0;
    growing_component& component = components_[k];
    const local_id from = component.members[component.next++];
    for (const local_id other : graph_.row(from)) {
      std::size_t& mark = mark_[index(other)];
      if (part_[index(other)] != part_searched_ || mark == left_)
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

  void join(std::size_t j, std::size_t k) {
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

  /// Breadth first from the first seed of each component.
  std::vector<local_id> members_but_of(std::size_t heaviest, std::span<const local_id> leaving) {
    const std::size_t seen = next_mark_++;
    for (const local_id s : leaving)
      mark_[index(s)] = seen;
    std::vector<local_id> members;
    for (std::size_t k = 0; k < seeds_.size(); ++k) {
      if (leader(k) == heaviest || mark_[index(seeds_[k])] == seen)
        continue;
      mark_[index(seeds_[k])] = seen;
      members.push_back(seeds_[k]);
      for (std::size_t m = members.size() - 1; m < members.size(); ++m)
        for (const local_id other : graph_.row(members[m]))
          if (part_[index(other)] == part_searched_ && mark_[index(other)] != seen) {
            mark_[index(other)] = seen;
            members.push_back(other);
          }
    }
    return members;
  }

  const csr_graph& graph_;
  std::span<const local_id> part_;
  std::vector<std::size_t> mark_; ///< per super-element: of the search that came there last
  std::size_t next_mark_ = 1;
  // Of the search at hand:
  local_id part_searched_ = no_id;
  std::size_t left_ = 0; ///< mark of those that leave; the k-th seed's is k + 1 larger
  std::vector<local_id> seeds_;
  std::vector<std::size_t> leader_; ///< per seed: the one whose component its own has joined, or itself
  std::vector<growing_component> components_;
};

} // namespace dovetail
