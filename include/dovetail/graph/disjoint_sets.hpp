/// @file
/// Disjoint sets that only grow: the bookkeeping of contraction.
#pragma once

#include "dovetail/core/ids.hpp"

#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// Union-find with path halving; a set's root is its smallest member, so names do not depend on the order of
/// unions. Each set carries the sum of its members' weights. Amortised cost per call: logarithmic at worst.
class disjoint_sets {
public:
  explicit disjoint_sets(std::vector<double> weights) : parent_(weights.size()), weight_(std::move(weights)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  explicit disjoint_sets(std::size_t count) : disjoint_sets(std::vector<double>(count, 1.0)) {}

  std::size_t size() const { return parent_.size(); }
  /// The smallest member of the set of `member`.
  local_id find(local_id member) {
    while (parent(member) != member) {
      parent(member) = parent(parent(member));
      member = parent(member);
    }
    return member;
  }
  /// The weight of the whole set that `member` is in.
  double weight(local_id member) { return weight_[find(member)]; }
  /// Joins two sets; returns false when they are one already.
  bool unite(local_id a, local_id b) {
    a = find(a);
    b = find(b);
    if (a == b)
      return false;
    if (b < a)
      std::swap(a, b);
    parent(b) = a;
    weight_[a] += weight_[b];
    return true;
  }

  /// Sets numbered 0, 1, ... in order of their smallest members.
  struct numbered {
    std::vector<local_id> of_member; ///< the set of each member
    local_id count = 0;              ///< how many sets there are
  };
  /// The sets as they are now. Linear.
  numbered number_sets() {
    numbered sets;
    sets.of_member.resize(size());
    for (std::size_t i = 0; i < size(); ++i) {
      const local_id root = find(static_cast<local_id>(i)); // the smallest member, so already numbered
      sets.of_member[i] = root == static_cast<local_id>(i) ? sets.count++ : sets.of_member[root];
    }
    return sets;
  }

private:
  local_id& parent(local_id member) { return parent_[member]; }

  std::vector<local_id> parent_;
  std::vector<double> weight_;
};

} // namespace dovetail
