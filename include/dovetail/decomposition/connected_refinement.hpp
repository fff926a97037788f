/// @file
/// Balance and cut of a decomposition, improved without losing what it already has.
#pragma once

#include "dovetail/decomposition/reassignment.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <queue>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

/// Moves single super-elements between neighbouring parts. A move is made when it evens out an overweight
/// part, or, within the limits, when it shrinks the cut, which sheds refused sides because these are dear;
/// and only when the part it leaves stays connected and no boundary defect is added. Each kind of move lowers
/// a quantity (the sum of squared weights, the cut), and the number of rounds is capped, so this terminates.
template <int D>
class connected_refinement {
public:
  /// `limits[p]`: the weight that part p should not exceed.
  connected_refinement(reassignable_parts<D>& parts, std::vector<double> limits)
      : parts_(parts), limits_(std::move(limits)), connection_(limits_.size(), 0.0) {}

  /// Returns the number of moves.
  std::size_t run(int max_rounds = 10) {
    std::size_t moves = 0;
    for (int round = 0; round < max_rounds; ++round) {
      const std::size_t made = balance() + shrink_cut();
      if (made == 0)
        break;
      moves += made;
    }
    return moves;
  }

private:
  struct move {
    double gain = 0; ///< by how much the cut shrinks
    local_id super = no_id;
    local_id to = no_id;
  };

  template <class Id>
  static std::size_t index(Id id) {
    return static_cast<std::size_t>(id);
  }
  double weight_of(local_id super) const { return parts_.graph().node_weights[index(super)]; }
  bool is_over(local_id part) const { return parts_.weight_of_part(part) > limits_[index(part)]; }

  /// Calls `consider(part, gain)` for every other part beside a super-element.
  template <class Consider>
  void for_each_target(local_id super, const Consider& consider) {
    const csr_graph& graph = parts_.graph();
    const local_id own = parts_.part_of(super);
    const auto row = graph.row(super);
    const auto begin = index(graph.offsets[index(super)]);
    double inside = 0;
    touched_.clear();
    for (std::size_t k = 0; k < row.size(); ++k) {
      const local_id p = parts_.part_of(row[k]);
      if (p == own) {
        inside += graph.edge_weights[begin + k];
        continue;
      }
      if (connection_[index(p)] == 0)
        touched_.push_back(p);
      connection_[index(p)] += graph.edge_weights[begin + k];
    }
    for (const local_id p : touched_) {
      const double gain = connection_[index(p)] - inside;
      connection_[index(p)] = 0;
      consider(p, gain);
    }
  }

  bool is_allowed(const move& m) {
    const std::array<local_id, 1> supers{m.super};
    return parts_.keeps_connected(supers) &&
           parts_.defects_removed_by(supers, m.to, parts_.points_of(supers)) >= 0;
  }

  /// Relieves overweight parts, the heaviest first.
  std::size_t balance() {
    std::vector<bool> stuck(limits_.size(), false);
    std::size_t moves = 0;
    while (moves < index(parts_.super_count())) {
      local_id heaviest = no_id;
      for (std::size_t p = 0; p < limits_.size(); ++p) {
        const auto part = static_cast<local_id>(p);
        if (!stuck[p] && is_over(part) &&
            (heaviest == no_id || parts_.weight_of_part(part) > parts_.weight_of_part(heaviest)))
          heaviest = part;
      }
      if (heaviest == no_id)
        break;
      if (relieve(heaviest))
        ++moves;
      else
        stuck[index(heaviest)] = true;
    }
    return moves;
  }

  /// Makes the move out of a part that costs least cut per weight; false when none is allowed.
  bool relieve(local_id heavy) {
    std::vector<move> moves;
    for (local_id s = 0; s < parts_.super_count(); ++s) {
      if (parts_.part_of(s) != heavy || weight_of(s) <= 0)
        continue;
      for_each_target(s, [&](local_id p, double gain) {
        if (parts_.weight_of_part(p) + weight_of(s) < parts_.weight_of_part(heavy))
          moves.push_back({gain / weight_of(s), s, p});
      });
    }
    std::sort(moves.begin(), moves.end(), [](const move& a, const move& b) {
      return std::tuple(-a.gain, a.super, a.to) < std::tuple(-b.gain, b.super, b.to);
    });
    for (const move& m : moves)
      if (is_allowed(m)) {
        parts_.assign(std::array{m.super}, m.to);
        return true;
      }
    return false;
  }

  /// One sweep of moves that shrink the cut and keep the limits.
  std::size_t shrink_cut() {
    std::size_t moves = 0;
    for (local_id s = 0; s < parts_.super_count(); ++s) {
      move best;
      for_each_target(s, [&](local_id p, double gain) {
        const bool fits = parts_.weight_of_part(p) + weight_of(s) <= limits_[index(p)];
        if (fits && gain > best.gain + 1e-9)
          best = {gain, s, p};
      });
      if (best.to != no_id && is_allowed(best)) {
        parts_.assign(std::array{s}, best.to);
        ++moves;
      }
    }
    return moves;
  }

  reassignable_parts<D>& parts_;
  std::vector<double> limits_;
  std::vector<double> connection_; ///< scratch: weight of the edges from one super-element to each part
  std::vector<local_id> touched_;
};

} // namespace dovetail
