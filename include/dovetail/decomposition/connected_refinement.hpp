/// @file
/// Balance and cut of a decomposition, improved without losing what it already has.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/decomposition/manifold_repair.hpp"
#include "dovetail/decomposition/reassignment.hpp"
#include "dovetail/partition/move_gains.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace dovetail {

/// Moves super-elements between neighbouring parts: out of overweight parts, and wherever the cut shrinks,
/// which sheds refused sides because these are dear. What a move would spoil is mended at once, by moving
/// along what it cuts off, repairing the boundaries and relieving the other part; if all of that together is
/// no gain, it is taken back. Parts stay connected. Every step that is kept improves the partition's standing
/// (defects, then excess weight, then cut), so this terminates.
template <int D>
class connected_refinement {
public:
  explicit connected_refinement(reassignable_parts<D>& parts, progress on_progress = {})
      : parts_(parts), repair_(parts), gains_(parts.graph(), parts.part_of_supers(), parts.part_count()),
        on_progress_(std::move(on_progress)) {}

  /// Balances, then shrinks the cut, until a round changes nothing or `max_rounds` are done.
  void run(int max_rounds = 10) {
    for (int round = 0; round < max_rounds; ++round) {
      const std::size_t before = parts_.assignments();
      balance();
      shrink_cut();
      if (parts_.assignments() == before)
        break;
    }
  }

private:
  struct move {
    double gain = 0; ///< by how much the cut shrinks
    local_id super = no_id;
    local_id to = no_id;
  };
  static constexpr double rounding = 1e-9;

  double weight_of(local_id super) const { return parts_.graph().node_weights[super]; }

  bool is_harmless(const move& m) {
    const std::array<local_id, 1> supers{m.super};
    if (!parts_.keeps_connected(supers))
      return false;
    const auto is_none_added = [](const defect_count& removed) {
      return removed.edges >= 0 && removed.points >= 0;
    };
    return is_none_added(parts_.defects_removed_by(supers, m.to, is_none_added));
  }

  /// Relieves overweight parts, the heaviest first.
  void balance() {
    std::vector<bool> stuck(parts_.part_count(), false);
    for (local_id moves = 0; moves < parts_.super_count(); ++moves) {
      on_progress_.stop_if_requested();
      local_id heaviest = no_id;
      for (const local_id part : parts_.overweight())
        if (!stuck[part] &&
            (heaviest == no_id || parts_.weight_of_part(part) > parts_.weight_of_part(heaviest)))
          heaviest = part;
      if (heaviest == no_id)
        break;
      if (!relieve(heaviest))
        stuck[heaviest] = true;
    }
  }

  /// Makes the harmless move out of a part that costs least cut per weight; false when there is none.
  bool relieve(local_id heavy) {
    std::vector<move> moves;
    for (const local_id s : parts_.border_of(heavy)) {
      if (weight_of(s) <= 0)
        continue;
      gains_.for_each_target(s, [&](local_id p, double gain) {
        if (parts_.weight_of_part(p) + weight_of(s) < parts_.weight_of_part(heavy))
          moves.push_back({gain / weight_of(s), s, p});
      });
    }
    // Mostly one of the first is harmless, so they are sorted no further than that.
    const auto is_dearer = [](const move& a, const move& b) {
      return std::tuple(-a.gain, a.super, a.to) > std::tuple(-b.gain, b.super, b.to);
    };
    std::make_heap(moves.begin(), moves.end(), is_dearer);
    for (; !moves.empty(); moves.pop_back()) {
      std::pop_heap(moves.begin(), moves.end(), is_dearer);
      if (is_harmless(moves.back())) {
        parts_.assign(std::array{moves.back().super}, moves.back().to);
        return true;
      }
    }
    return false;
  }

  /// One sweep of moves that shrink the cut.
  void shrink_cut() {
    for (local_id s = 0; s < parts_.super_count(); ++s) {
      if (s % 4096 == 0)
        on_progress_.stop_if_requested();
      move best{rounding, no_id, no_id};
      gains_.for_each_target(s, [&](local_id p, double gain) {
        if (gain > best.gain)
          best = {gain, s, p};
      });
      if (best.to != no_id)
        attempt(best);
    }
  }

  /// Makes a move with all it entails, if that is a gain.
  void attempt(const move& m) {
    constexpr int most_reliefs = 30;
    const auto before = parts_.standing();
    const auto place = parts_.mark();
    std::vector<local_id> moved{m.super};
    if (!parts_.keeps_connected(moved)) {
      const std::vector<local_id> cut_off = parts_.components_cut_off_by(moved);
      append(moved, cut_off);
      if (!parts_.keeps_connected(moved)) // it was all of its part
        return;
    }
    parts_.assign(moved, m.to);
    if (parts_.standing().defects != before.defects)
      repair_.repair(parts_.points_of(moved));
    for (int k = 0; k < most_reliefs && parts_.is_over_limit(m.to) && relieve(m.to); ++k) {
    }
    if (!parts_.standing().is_better_than(before))
      parts_.go_back_to(place);
  }

  reassignable_parts<D>& parts_;
  manifold_repair<D> repair_;
  move_gains gains_;
  progress on_progress_;
};

} // namespace dovetail
