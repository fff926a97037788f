/// @file
/// Parts made of super-elements, and what changes when some of these go to another part.
#pragma once

#include "dovetail/decomposition/boundary_defects.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// A partition of the super-elements that can be changed and asked about connectivity and defects.
///
/// `graph` is the graph of super-elements with edges inside one material only, so no change that follows its
/// edges mixes materials. All parts are connected at the start; `keeps_connected` keeps it so.
template <int D>
class reassignable_parts {
public:
  reassignable_parts(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                     std::span<const local_id> super_of_element, const csr_graph& graph,
                     std::span<local_id> part, int parts)
      : mesh_(mesh), defects_(mesh, sides), super_(super_of_element), graph_(graph), part_(part),
        weights_(part_weights(graph, part, parts)), sizes_(static_cast<std::size_t>(parts), 0),
        element_begins_(static_cast<std::size_t>(graph.node_count()) + 1, 0),
        elements_(super_of_element.size()), mark_(part.size(), 0) {
    for (const local_id p : part)
      ++sizes_[index(p)];
    for (const local_id s : super_)
      ++element_begins_[index(s) + 1];
    for (std::size_t s = 0; s + 1 < element_begins_.size(); ++s)
      element_begins_[s + 1] += element_begins_[s];
    std::vector<std::size_t> next(element_begins_.begin(), element_begins_.end() - 1);
    for (std::size_t e = 0; e < super_.size(); ++e)
      elements_[next[index(super_[e])]++] = static_cast<local_id>(e);
  }

  const csr_graph& graph() const { return graph_; }
  std::size_t point_count() const { return mesh_.points.size(); }
  local_id super_count() const { return graph_.node_count(); }
  local_id part_of(local_id super) const { return part_[index(super)]; }
  double weight_of_part(local_id part) const { return weights_[index(part)]; }
  std::size_t part_count() const { return weights_.size(); }

  void assign(std::span<const local_id> supers, local_id to) {
    for (const local_id s : supers) {
      local_id& from = part_[index(s)];
      weights_[index(from)] -= graph_.node_weights[index(s)];
      weights_[index(to)] += graph_.node_weights[index(s)];
      --sizes_[index(from)];
      ++sizes_[index(to)];
      from = to;
    }
  }

  /// Boundary defects at a point, or at several.
  int defects_at(local_id point) {
    return defects_.count_at(point, [this](local_id e) { return part_[index(super_[index(e)])]; });
  }
  int defects_at(std::span<const local_id> points) {
    int total = 0;
    for (const local_id v : points)
      total += defects_at(v);
    return total;
  }
  /// By how much a change, which is undone again, lowers the number of defects at `points`.
  int defects_removed_by(std::span<const local_id> supers, local_id to, std::span<const local_id> points) {
    const local_id from = part_of(supers[0]);
    const int before = defects_at(points);
    assign(supers, to);
    const int after = defects_at(points);
    assign(supers, from);
    return before - after;
  }

  /// The points of the elements of some super-elements, growing.
  std::vector<local_id> points_of(std::span<const local_id> supers) const {
    std::vector<local_id> points;
    for (const local_id s : supers)
      for (std::size_t k = element_begins_[index(s)]; k < element_begins_[index(s) + 1]; ++k)
        for (const local_id v : mesh_.elements[index(elements_[k])])
          points.push_back(v);
    make_unique(points);
    return points;
  }
  /// The super-elements at a point, growing.
  std::vector<local_id> supers_at(local_id point) const {
    std::vector<local_id> supers;
    for (const local_id e : defects_.around().at(point))
      supers.push_back(super_[index(e)]);
    make_unique(supers);
    return supers;
  }
  /// The parts next to super-elements of one part, growing.
  std::vector<local_id> parts_beside(std::span<const local_id> supers) const {
    std::vector<local_id> parts;
    for (const local_id s : supers)
      for (const local_id other : graph_.row(s))
        if (part_of(other) != part_of(s))
          parts.push_back(part_of(other));
    make_unique(parts);
    return parts;
  }
  double weight_of(std::span<const local_id> supers) const {
    double total = 0;
    for (const local_id s : supers)
      total += graph_.node_weights[index(s)];
    return total;
  }

  /// Does the part of these super-elements (which are all of one part) stay connected and non-empty without
  /// them? Searches from one neighbour until all others are reached: mostly a few steps.
  bool keeps_connected(std::span<const local_id> supers) {
    const local_id part = part_of(supers[0]);
    if (sizes_[index(part)] <= supers.size())
      return false;
    ++stamp_;
    const std::size_t leaving = 3 * stamp_; // marks of this call: leaving, to be reached, reached
    const std::size_t wanted = leaving + 1;
    const std::size_t reached = leaving + 2;
    for (const local_id s : supers)
      mark_[index(s)] = leaving;
    std::size_t missing = 0;
    stack_.clear();
    for (const local_id s : supers)
      for (const local_id other : graph_.row(s))
        if (part_of(other) == part && mark_[index(other)] != leaving && mark_[index(other)] != wanted) {
          mark_[index(other)] = wanted;
          ++missing;
          if (stack_.empty())
            stack_.push_back(other);
        }
    if (missing == 0)
      return false;
    mark_[index(stack_.front())] = reached;
    --missing;
    for (std::size_t k = 0; k < stack_.size() && missing > 0; ++k)
      for (const local_id other : graph_.row(stack_[k])) {
        if (part_of(other) != part || mark_[index(other)] == leaving || mark_[index(other)] == reached)
          continue;
        if (mark_[index(other)] == wanted)
          --missing;
        mark_[index(other)] = reached;
        stack_.push_back(other);
      }
    return missing == 0;
  }

private:
  template <class Id>
  static std::size_t index(Id id) {
    return static_cast<std::size_t>(id);
  }
  static void make_unique(std::vector<local_id>& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }

  const simplicial_mesh<D>& mesh_;
  boundary_defects<D> defects_;
  std::span<const local_id> super_;
  const csr_graph& graph_;
  std::span<local_id> part_;
  std::vector<double> weights_;             ///< per part
  std::vector<std::size_t> sizes_;          ///< super-elements per part
  std::vector<std::size_t> element_begins_; ///< rows of `elements_`, one per super-element
  std::vector<local_id> elements_;
  std::vector<std::size_t> mark_; ///< per super-element, see keeps_connected
  std::size_t stamp_ = 0;
  std::vector<local_id> stack_;
};

} // namespace dovetail
