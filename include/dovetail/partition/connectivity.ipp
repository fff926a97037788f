/// @file
/// What `connectivity.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/graph/contraction.hpp"
#include "dovetail/partition/connectivity.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace dovetail {

namespace detail {

/// The components of parts, of which some join others.
class joined_components {
public:
  joined_components(const csr_graph& graph, std::span<const local_id> part)
      : of_node_(components_within(graph, part)), weight_(count(), 0.0), part_of_(count(), no_id) {
    for (std::size_t v = 0; v < part.size(); ++v) {
      weight_[of_node_.of_node[v]] += graph.node_weights[v];
      part_of_[of_node_.of_node[v]] = part[v];
    }
  }

  /// Components that are not the heaviest of their part, the lightest first.
  std::vector<std::size_t> strays(int parts) const {
    std::vector<std::size_t> heaviest(static_cast<std::size_t>(parts), count());
    for (std::size_t c = 0; c < count(); ++c) {
      std::size_t& best = heaviest[part_of_[c]];
      if (best == count() || weight_[c] > weight_[best])
        best = c;
    }
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < count(); ++c)
      if (heaviest[part_of_[c]] != c)
        found.push_back(c);
    stable_sort_all(found, [&](std::size_t a, std::size_t b) { return weight_[a] < weight_[b]; });
    return found;
  }

  /// Joins each stray, with those that have joined it, to the component with which it shares most; returns
  /// how many were joined.
  std::size_t join(const csr_graph& graph, const std::vector<std::size_t>& strays) {
    graph_ = contract(graph, of_node_.of_node, of_node_.count);
    into_.resize(count());
    std::iota(into_.begin(), into_.end(), std::size_t{0});
    shared_.assign(count(), 0.0);
    members_.resize(count());
    for (std::size_t c = 0; c < count(); ++c)
      members_[c] = {c};
    std::size_t joined = 0;
    for (const std::size_t stray : strays)
      if (whole_of(stray) == stray)
        if (const std::size_t best = nearest(stray); best != stray) {
          into_[stray] = best;
          append(members_[best], members_[stray]);
          ++joined;
        }
    return joined;
  }

  /// The part that each node is in now.
  void write(std::span<local_id> part) {
    for (std::size_t v = 0; v < part.size(); ++v)
      part[v] = part_of_[whole_of(static_cast<std::size_t>(of_node_.of_node[v]))];
  }

private:
  std::size_t count() const { return static_cast<std::size_t>(of_node_.count); }

  /// The component that one is in now.
  std::size_t whole_of(std::size_t c) {
    while (into_[c] != c)
      c = into_[c] = into_[into_[c]];
    return c;
  }

  /// The component that shares most with one, the first of several; itself where none shares anything.
  std::size_t nearest(std::size_t stray) {
    std::vector<std::size_t> neighbours;
    for (const std::size_t member : members_[stray]) {
      const auto row = graph_.row(static_cast<local_id>(member));
      const auto begin = static_cast<std::size_t>(graph_.offsets[member]);
      for (std::size_t k = 0; k < row.size(); ++k)
        if (const std::size_t other = whole_of(static_cast<std::size_t>(row[k])); other != stray) {
          shared_[other] += graph_.edge_weights[begin + k];
          neighbours.push_back(other);
        }
    }
    if (neighbours.empty())
      return stray;
    sort_unique(neighbours);
    std::size_t best = neighbours.front();
    for (const std::size_t other : neighbours)
      if (shared_[other] > shared_[best])
        best = other;
    for (const std::size_t other : neighbours)
      shared_[other] = 0;
    return best;
  }

  labelled_components of_node_;
  std::vector<double> weight_;                    ///< per component
  std::vector<local_id> part_of_;                 ///< per component
  csr_graph graph_;                               ///< of components
  std::vector<std::size_t> into_;                 ///< per component: the one that it joined, or itself
  std::vector<double> shared_;                    ///< scratch, 0 between uses
  std::vector<std::vector<std::size_t>> members_; ///< per component: those that joined it, and itself
};

} // namespace detail

DOVETAIL_INLINE std::size_t join_stray_components(const csr_graph& graph, std::span<local_id> part,
                                                  int parts) {
  detail::joined_components components(graph, part);
  const std::vector<std::size_t> strays = components.strays(parts);
  if (strays.empty())
    return 0;
  const std::size_t joined = components.join(graph, strays);
  components.write(part);
  return joined;
}

} // namespace dovetail
