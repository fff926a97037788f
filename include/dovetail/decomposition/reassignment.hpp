/// @file
/// Parts made of super-elements, and what changes when some of these go to another part.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/boundary_defects.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// How good a partition is, against where it started: what is to be lowered, most important first.
struct partition_standing {
  /// What a point where a boundary is not manifold may cost in cut: as much as a side of a quarter of its
  /// angle missing. Meshers cope with such points, but not all do with edges, which are always avoided first.
  static constexpr double price_of_point = 50;

  defect_count defects; ///< of the boundaries of parts
  double excess = 0;    ///< weight over the limits
  double cut = 0;       ///< weight of the edges between parts; refused sides are dear

  double cost() const { return cut + price_of_point * defects.points; }
  bool is_better_than(const partition_standing& other) const {
    constexpr double rounding = 1e-9;
    if (defects.edges != other.defects.edges)
      return defects.edges < other.defects.edges;
    if (std::abs(excess - other.excess) > rounding * (1 + other.excess))
      return excess < other.excess;
    return cost() < other.cost() - rounding * (1 + std::abs(other.cost()));
  }
};

/// A partition of the super-elements that can be changed, asked and set back.
///
/// `graph` is the graph of super-elements with edges inside one material only, so no change that follows its
/// edges mixes materials. All parts are connected at the start; `keeps_connected` keeps it so.
template <int D>
class reassignable_parts {
public:
  /// `limits[p]`: the weight that part p should not exceed.
  reassignable_parts(const simplicial_mesh<D>& mesh, const side_table<D>& sides,
                     std::span<const local_id> super_of_element, const csr_graph& graph,
                     std::span<local_id> part, std::vector<double> limits)
      : mesh_(mesh), sides_(sides), defects_(mesh, sides), super_(super_of_element), graph_(graph),
        part_(part), limits_(std::move(limits)),
        weights_(part_weights(graph, part, static_cast<int>(limits_.size()))), sizes_(limits_.size(), 0),
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

  const simplicial_mesh<D>& mesh() const { return mesh_; }
  const side_table<D>& sides() const { return sides_; }
  const csr_graph& graph() const { return graph_; }
  std::span<const local_id> elements_at(local_id point) const { return defects_.around().at(point); }
  local_id super_of(local_id element) const { return super_[index(element)]; }
  std::size_t point_count() const { return mesh_.points.size(); }
  local_id super_count() const { return graph_.node_count(); }
  local_id part_of(local_id super) const { return part_[index(super)]; }
  std::size_t part_count() const { return weights_.size(); }
  double weight_of_part(local_id part) const { return weights_[index(part)]; }
  double limit_of_part(local_id part) const { return limits_[index(part)]; }
  /// May super-elements of this weight be moved just because something else cuts them off?
  bool is_light(double weight, local_id part) const {
    constexpr double light_fraction = 0.1;
    return weight <= light_fraction * limit_of_part(part);
  }
  bool is_over_limit(local_id part) const { return weights_[index(part)] > limits_[index(part)]; }

  /// Gives super-elements of one part to another.
  void assign(std::span<const local_id> supers, local_id to) {
    const std::vector<local_id> points = points_of(supers);
    standing_.cut += cut_added_by(supers, to);
    const defect_count before = defects_at(points);
    for (const local_id s : supers) {
      trail_.emplace_back(s, part_of(s));
      put(s, to);
    }
    standing_.defects += defects_at(points) - before;
  }

  /// A place to go back to.
  struct checkpoint {
    std::size_t trail_length;
    partition_standing standing;
  };
  checkpoint mark() const { return {trail_.size(), standing_}; }
  void go_back_to(const checkpoint& place) {
    for (; trail_.size() > place.trail_length; trail_.pop_back())
      put(trail_.back().first, trail_.back().second);
    standing_ = place.standing;
  }
  /// Super-elements that have been assigned since the start, counting repetitions.
  std::size_t assignments() const { return trail_.size(); }
  /// Defects and cut are counted from the start on, so they may be negative.
  partition_standing standing() const {
    partition_standing now = standing_;
    now.excess = 0;
    for (std::size_t p = 0; p < weights_.size(); ++p)
      now.excess += std::max(0.0, weights_[p] - limits_[p]);
    return now;
  }

  /// Boundary defects at a point, or at several.
  defect_count defects_at(local_id point) {
    return defects_.count_at(point, [this](local_id e) { return part_[index(super_[index(e)])]; });
  }
  defect_count defects_at(std::span<const local_id> points) {
    defect_count total;
    for (const local_id v : points)
      total += defects_at(v);
    return total;
  }
  /// By how much a change, which is undone again, lowers the number of defects at `points`.
  defect_count defects_removed_by(std::span<const local_id> supers, local_id to,
                                  std::span<const local_id> points) {
    const local_id from = part_of(supers[0]);
    const defect_count before = defects_at(points);
    for (const local_id s : supers)
      part_[index(s)] = to;
    const defect_count after = defects_at(points);
    for (const local_id s : supers)
      part_[index(s)] = from;
    return before - after;
  }

  /// The points of the elements of some super-elements, growing.
  std::vector<local_id> points_of(std::span<const local_id> supers) const {
    std::vector<local_id> points;
    for (const local_id s : supers)
      for (std::size_t k = element_begins_[index(s)]; k < element_begins_[index(s) + 1]; ++k)
        for (const local_id v : mesh_.elements[index(elements_[k])])
          points.push_back(v);
    sort_unique(points);
    return points;
  }
  /// The super-elements at a point, growing.
  std::vector<local_id> supers_at(local_id point) const {
    std::vector<local_id> supers;
    for (const local_id e : defects_.around().at(point))
      supers.push_back(super_[index(e)]);
    sort_unique(supers);
    return supers;
  }
  /// The parts next to super-elements of one part, growing.
  std::vector<local_id> parts_beside(std::span<const local_id> supers) const {
    std::vector<local_id> parts;
    for (const local_id s : supers)
      for (const local_id other : graph_.row(s))
        if (part_of(other) != part_of(s))
          parts.push_back(part_of(other));
    sort_unique(parts);
    return parts;
  }
  /// By how much the cut grows when super-elements of one part go to another.
  double cut_added_by(std::span<const local_id> supers, local_id to) const {
    const local_id from = part_of(supers[0]);
    double added = 0;
    for (const local_id s : supers) {
      const auto row = graph_.row(s);
      const auto begin = index(graph_.offsets[index(s)]);
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (std::find(supers.begin(), supers.end(), row[k]) != supers.end())
          continue;
        const local_id other = part_of(row[k]);
        const double weight = graph_.edge_weights[begin + k];
        added += other == from ? weight : other == to ? -weight : 0.0;
      }
    }
    return added;
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
    const std::size_t leaving = fresh_marks(3); // marks of this call: leaving, to be reached, reached
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

  /// What the part of these super-elements falls into without them, but for its heaviest piece. Linear in the
  /// part.
  std::vector<local_id> pieces_cut_off_by(std::span<const local_id> supers) {
    const local_id part = part_of(supers[0]);
    const std::size_t seen = fresh_marks(1);
    for (const local_id s : supers)
      mark_[index(s)] = seen;
    std::vector<std::vector<local_id>> pieces;
    for (const local_id s : supers)
      for (const local_id seed : graph_.row(s)) {
        if (part_of(seed) != part || mark_[index(seed)] == seen)
          continue;
        std::vector<local_id> piece{seed};
        mark_[index(seed)] = seen;
        for (std::size_t k = 0; k < piece.size(); ++k)
          for (const local_id other : graph_.row(piece[k]))
            if (part_of(other) == part && mark_[index(other)] != seen) {
              mark_[index(other)] = seen;
              piece.push_back(other);
            }
        pieces.push_back(std::move(piece));
      }
    const auto heaviest = std::max_element(pieces.begin(), pieces.end(), [&](const auto& a, const auto& b) {
      return weight_of(a) < weight_of(b);
    });
    std::vector<local_id> cut_off;
    for (auto it = pieces.begin(); it != pieces.end(); ++it)
      if (it != heaviest)
        cut_off.insert(cut_off.end(), it->begin(), it->end());
    return cut_off;
  }

private:
  template <class Id>
  static std::size_t index(Id id) {
    return static_cast<std::size_t>(id);
  }

  void put(local_id super, local_id to) {
    local_id& from = part_[index(super)];
    weights_[index(from)] -= graph_.node_weights[index(super)];
    weights_[index(to)] += graph_.node_weights[index(super)];
    --sizes_[index(from)];
    ++sizes_[index(to)];
    from = to;
  }
  /// The first of several marks that no super-element has.
  std::size_t fresh_marks(std::size_t count) {
    const std::size_t first = next_mark_;
    next_mark_ += count;
    return first;
  }

  const simplicial_mesh<D>& mesh_;
  const side_table<D>& sides_;
  boundary_defects<D> defects_;
  std::span<const local_id> super_;
  const csr_graph& graph_;
  std::span<local_id> part_;
  std::vector<double> limits_;              ///< per part
  std::vector<double> weights_;             ///< per part
  std::vector<std::size_t> sizes_;          ///< super-elements per part
  std::vector<std::size_t> element_begins_; ///< rows of `elements_`, one per super-element
  std::vector<local_id> elements_;
  std::vector<std::size_t> mark_; ///< per super-element, of the search that came there last
  std::size_t next_mark_ = 1;
  std::vector<std::pair<local_id, local_id>> trail_; ///< (super-element, part it came from)
  partition_standing standing_;                      ///< but for the excess, which is found when asked for
  std::vector<local_id> stack_;
};

} // namespace dovetail
