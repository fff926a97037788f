/// @file
/// What a part falls into when some of its super-elements leave it.
#pragma once

#include "dovetail/graph/csr_graph.hpp"

#include <cstddef>
#include <span>
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
  std::vector<local_id> cut_off_by(std::span<const local_id> leaving, double part_weight);

private:
  struct growing_component {
    std::vector<local_id> members; ///< reached; those from `next` on have not been searched from
    std::size_t next = 0;
    double weight = 0;

    bool is_complete() const { return next == members.size(); }
  };

  double weight(local_id super) const { return graph_.node_weights[super]; }

  /// One component for each neighbour of those that leave; returns how many these are.
  std::size_t plant(std::span<const local_id> leaving);

  std::size_t leader(std::size_t seed) const {
    while (leader_[seed] != seed)
      seed = leader_[seed];
    return seed;
  }

  /// Grows the planted components, which become one where they meet, until one is left, or all others are
  /// complete
  /// (`until_first`: or any is). Returns how many are left.
  std::size_t grow(bool until_first);

  /// Goes on with one member of a component; returns how many other components it met.
  std::size_t search_next(std::size_t k);

  void join(std::size_t j, std::size_t k);

  /// Breadth first from the first seed of each component.
  std::vector<local_id> members_but_of(std::size_t heaviest, std::span<const local_id> leaving);

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

#ifndef DOVETAIL_COMPILED
#include "dovetail/decomposition/cut_off_components.ipp"
#endif
