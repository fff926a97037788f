/// @file
/// The graphs of groups of nodes, each by itself.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/graph/csr_graph.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// The nodes of a graph in groups. Graph and groups must outlive it. To make it is linear in the nodes.
class node_groups {
public:
  /// `group` is in [0, groups) for every node.
  node_groups(const csr_graph& graph, std::span<const local_id> group, int groups);

  std::size_t size() const { return nodes_.size(); }       ///< how many groups there are
  std::size_t node_count() const { return place_.size(); } ///< of the graph
  /// The nodes of a group, growing.
  std::span<const local_id> nodes(std::size_t group) const { return nodes_[group]; }
  /// How many nodes each group has.
  std::vector<local_id> counts() const;
  /// The nodes of a group with the edges between them, by their places in `nodes(group)`. Linear in these.
  csr_graph graph_of(std::size_t group) const;
  /// A part per node of the graph, where every group is divided by itself: the parts of a group follow those
  /// of the one before. Linear in the nodes.
  /// \param parts_of_group per group the part of each node, by its place in `nodes(group)`
  /// \param counts how many parts each group has
  std::vector<local_id> joined(std::span<const std::vector<local_id>> parts_of_group,
                               std::span<const int> counts) const;

private:
  const csr_graph& graph_;
  std::span<const local_id> group_;
  compressed_rows<local_id> nodes_;
  std::vector<local_id> place_; ///< of each node in its group
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/partition/node_groups.ipp"
#endif
