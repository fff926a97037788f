/// @file
/// Parts made of super-elements, and what changes when some of these go to another part.
#pragma once

#include "dovetail/core/compressed_rows.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/boundary_defects.hpp"
#include "dovetail/decomposition/cut_off_components.hpp"
#include "dovetail/decomposition/super_element_points.hpp"
#include "dovetail/graph/csr_graph.hpp"
#include "dovetail/partition/part_weights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

/// How good a partition is, against where it started: what is to be lowered, most important first.
struct partition_standing {
  /// What a point where a boundary is not manifold may cost in cut: as much as a side of a quarter of its
  /// angle missing. Meshers cope with such points, but not all do with edges, which are always avoided first.
  static constexpr double penalty_of_point = 50;

  defect_count defects; ///< of the boundaries of parts
  double excess = 0;    ///< weight over the limits
  double cut = 0;       ///< weight of the edges between parts; refused sides are dear

  /// The cut, with what non-manifold points count.
  double cost() const { return cut + penalty_of_point * defects.points; }
  /// Whether it is lower, defects before excess before cost.
  bool is_better_than(const partition_standing& other) const {
    if (defects.edges != other.defects.edges)
      return defects.edges < other.defects.edges;
    if (std::abs(excess - other.excess) > rounding * (1 + other.excess))
      return excess < other.excess;
    return is_cheaper_than(other);
  }
  /// Better without regard to weights: what the steps of a repair are, so that it comes to an end.
  bool is_mended_against(const partition_standing& other) const {
    return defects.edges != other.defects.edges ? defects.edges < other.defects.edges
                                                : is_cheaper_than(other);
  }

private:
  static constexpr double rounding = 1e-9;

  bool is_cheaper_than(const partition_standing& other) const {
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
      : reassignable_parts(
            std::make_shared<const super_element_points<D>>(mesh, sides, super_of_element, part.size()),
            graph, part, std::move(limits)) {}
  /// With what is known of the super-elements already.
  reassignable_parts(std::shared_ptr<const super_element_points<D>> supers, const csr_graph& graph,
                     std::span<local_id> part, std::vector<double> limits)
      : supers_(std::move(supers)), defects_(supers_->mesh(), supers_->sides(), supers_->stars()),
        graph_(graph), part_(part), limits_(std::move(limits)),
        weights_(part_weights(graph, part, static_cast<int>(limits_.size()))), sizes_(limits_.size(), 0),
        foreign_neighbours_(part.size(), 0), place_in_border_(part.size(), no_id), borders_(limits_.size()),
        counted_(mesh().points.size()), is_counted_(mesh().points.size(), 0), components_(graph, part) {
    for (local_id s = 0; s < super_count(); ++s) {
      ++sizes_[part_of(s)];
      join_border_if_there(s);
    }
    for (std::size_t p = 0; p < limits_.size(); ++p)
      change_weight(static_cast<local_id>(p), 0);
  }

  const simplicial_mesh<D>& mesh() const { return supers_->mesh(); } ///< the mesh that the elements are of
  const side_table<D>& sides() const { return supers_->sides(); }    ///< of that mesh
  const csr_graph& graph() const { return graph_; }
  /// The elements around a point.
  std::span<const local_id> elements_at(local_id point) const { return defects_.around()[point]; }
  /// The super-element that an element is in.
  local_id super_of(local_id element) const { return supers_->super_of(element); }
  std::size_t point_count() const { return mesh().points.size(); } ///< points of the mesh
  local_id super_count() const { return graph_.node_count(); }     ///< how many super-elements there are
  /// The part that a super-element is in now.
  local_id part_of(local_id super) const { return part_[super]; }
  /// The part that each super-element is in now.
  std::span<const local_id> part_of_supers() const { return part_; }
  std::size_t part_count() const { return weights_.size(); } ///< how many parts there are
  /// The sum of its elements' weights.
  double weight_of_part(local_id part) const { return weights_[part]; }
  /// Above it a part is overweight.
  double limit_of_part(local_id part) const { return limits_[part]; }
  /// May super-elements of this weight be moved just because something else cuts them off?
  bool is_light(double weight, local_id part) const {
    constexpr double light_fraction = 0.1;
    return weight <= light_fraction * limit_of_part(part);
  }
  /// Super-elements of one part with those that they cut off from it, which may go to another part; nothing
  /// where these are heavy, or all of the part.
  std::optional<std::vector<local_id>> with_cut_off(std::vector<local_id> supers, local_id to) {
    if (keeps_connected(supers))
      return supers;
    const std::vector<local_id> cut_off = components_cut_off_by(supers);
    append(supers, cut_off);
    if (!is_light(weight_of(cut_off), to) || !keeps_connected(supers))
      return std::nullopt;
    return supers;
  }
  /// Whether a part is overweight.
  bool is_over_limit(local_id part) const { return weights_[part] > limits_[part]; }
  /// The parts over their limits.
  const std::set<local_id>& overweight() const { return overweight_; }
  /// The super-elements of a part that have neighbours in other parts, in no order.
  std::span<const local_id> border_of(local_id part) const { return span_of(borders_[part]); }

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
    std::size_t trail_length;    ///< how many assignments had been made
    partition_standing standing; ///< how good the partition was
  };
  checkpoint mark() const { return {trail_.size(), standing_}; } ///< the state as it is now
  /// Takes back every assignment since then.
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
    for (const local_id p : overweight_)
      now.excess += weights_[p] - limits_[p];
    return now;
  }

  /// Boundary defects at a point, or at several.
  defect_count defects_at(local_id point) {
    if (is_counted_[point] == 0) {
      counted_[point] = count_at(point);
      is_counted_[point] = 1;
    }
    return counted_[point];
  }
  defect_count defects_at(std::span<const local_id> points) {
    defect_count total;
    for (const local_id v : points)
      total += defects_at(v);
    return total;
  }
  /// By how much giving super-elements of one part to another would lower the number of defects. Counts no
  /// further than `is_enough(bound)` is true, where the result is at most `bound`; then returns the bound.
  template <class IsEnough>
  defect_count defects_removed_by(std::span<const local_id> supers, local_id to, const IsEnough& is_enough) {
    const local_id from = part_of(supers[0]);
    const std::vector<local_id> points = points_of(supers);
    defect_count removed = defects_at(points);
    if (!is_enough(removed))
      return removed;
    for (const local_id s : supers)
      part_[s] = to;
    for (std::size_t k = 0; k < points.size() && is_enough(removed); ++k)
      removed = removed - count_at(points[k]);
    for (const local_id s : supers)
      part_[s] = from;
    return removed;
  }

  /// The points where something may change when these super-elements change their part, growing.
  std::vector<local_id> points_of(std::span<const local_id> supers) const {
    std::vector<local_id> points;
    for (const local_id s : supers)
      append(points, supers_->points_of(s));
    if (supers.size() > 1)
      sort_unique(points);
    return points;
  }
  /// The super-elements at a point, growing.
  std::vector<local_id> supers_at(local_id point) const { return supers_->supers_at(point); }
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
    constexpr std::size_t few = 8;
    std::vector<local_id> sorted; // of many; mostly it is one, for which nothing is allocated
    if (supers.size() > few) {
      sorted.assign(supers.begin(), supers.end());
      sort_all(sorted);
    }
    const auto moves = [&](local_id s) {
      return sorted.empty() ? std::find(supers.begin(), supers.end(), s) != supers.end()
                            : std::binary_search(sorted.begin(), sorted.end(), s);
    };
    double added = 0;
    for (const local_id s : supers) {
      const auto row = graph_.row(s);
      const std::size_t begin = graph_.offsets[s];
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (moves(row[k]))
          continue;
        const local_id other = part_of(row[k]);
        const double weight = graph_.edge_weights[begin + k];
        added += other == from ? weight : other == to ? -weight : 0.0;
      }
    }
    return added;
  }
  /// The sum of the super-elements' weights.
  double weight_of(std::span<const local_id> supers) const {
    double total = 0;
    for (const local_id s : supers)
      total += graph_.node_weights[s];
    return total;
  }

  /// Does the part of these super-elements (which are all of one part) stay connected and non-empty without
  /// them? Mostly a few steps.
  bool keeps_connected(std::span<const local_id> supers) {
    return sizes_[part_of(supers[0])] > supers.size() && components_.stays_connected(supers);
  }
  /// What the part of these super-elements falls into without them, but for its heaviest component.
  std::vector<local_id> components_cut_off_by(std::span<const local_id> supers) {
    return components_.cut_off_by(supers, weight_of_part(part_of(supers[0])));
  }

private:
  defect_count count_at(local_id point) {
    return defects_.count_at(point, [this](local_id e) { return part_[super_of(e)]; });
  }

  void put(local_id super, local_id to) {
    const local_id from = part_of(super);
    const double weight = graph_.node_weights[super];
    leave_border(super);
    part_[super] = to;
    --sizes_[from];
    ++sizes_[to];
    change_weight(from, -weight);
    change_weight(to, weight);
    for (const local_id other : graph_.row(super)) {
      const local_id p = part_of(other);
      if (p == from && foreign_neighbours_[other]++ == 0)
        join_border(other);
      else if (p == to && --foreign_neighbours_[other] == 0)
        leave_border(other);
    }
    join_border_if_there(super);
    for (const local_id v : supers_->points_of(super))
      is_counted_[v] = 0;
  }
  void change_weight(local_id part, double by) {
    weights_[part] += by;
    if (is_over_limit(part))
      overweight_.insert(part);
    else
      overweight_.erase(part);
  }

  void join_border_if_there(local_id super) {
    const auto row = graph_.row(super);
    foreign_neighbours_[super] = static_cast<local_id>(std::count_if(
        row.begin(), row.end(), [&](local_id other) { return part_of(other) != part_of(super); }));
    if (foreign_neighbours_[super] > 0)
      join_border(super);
  }
  void join_border(local_id super) {
    auto& border = borders_[part_of(super)];
    place_in_border_[super] = static_cast<local_id>(border.size());
    border.push_back(super);
  }
  void leave_border(local_id super) {
    local_id& place = place_in_border_[super];
    if (place == no_id)
      return;
    auto& border = borders_[part_of(super)];
    place_in_border_[border.back()] = place;
    border[place] = border.back();
    border.pop_back();
    place = no_id;
  }

  std::shared_ptr<const super_element_points<D>> supers_;
  boundary_defects<D> defects_;
  const csr_graph& graph_;
  std::span<local_id> part_;
  std::vector<double> limits_;               ///< per part
  std::vector<double> weights_;              ///< per part
  std::vector<std::size_t> sizes_;           ///< super-elements per part
  std::set<local_id> overweight_;            ///< parts above their limits
  std::vector<local_id> foreign_neighbours_; ///< per super-element: how many are in other parts
  std::vector<local_id> place_in_border_;    ///< per super-element: in the border of its part, or no_id
  std::vector<std::vector<local_id>> borders_;
  std::vector<defect_count> counted_;    ///< per point: its defects, where `is_counted_`
  std::vector<std::uint8_t> is_counted_; ///< per point
  cut_off_components components_;
  std::vector<std::pair<local_id, local_id>> trail_; ///< (super-element, part it came from)
  partition_standing standing_;                      ///< but for the excess, which is found when asked for
};

} // namespace dovetail
